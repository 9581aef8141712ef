#include "apps/data_set_files.hpp"

#include <Eigen/Core>
#include <string>
#include <vector>

#include "apps/config.hpp"
#include "datasets/io/atomic_file.hpp"
#include "datasets/io/labels_io.hpp"
#include "datasets/io/reference_io.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_writer.hpp"
#include "datasets/io/trajectory_io.hpp"
#include "datasets/sim/place_labels.hpp"

namespace sketchloc {
namespace {

/// The header of ROS map_server for a drawing whose scale is known.
std::string map_server_text(double px_per_m) {
  ConfigNode header;
  header.child("image").text = "drawing.png";
  header.child("resolution") = to_config(1.0 / px_per_m);
  header.child("negate") = to_config(0);  // not = "0": g++ 12 warns of that under -O3
  header.child("occupied_thresh").text = "0.65";
  header.child("free_thresh").text = "0.196";
  return to_yaml(header) + "origin: [0, 0, 0]\n";  // a list, which parameters never are
}

}  // namespace

void write_data_set(const std::filesystem::path& folder, const DataSet& data_set,
                    const RunDescription& made_by) {
  const Sketch& sketch = data_set.drawing.sketch;
  std::vector<Eigen::Vector2d> path_in_sketch;
  for (const ReferencePose& pose : data_set.reference.poses) {
    path_in_sketch.push_back(pose.sketch_from_robot.translation());
  }
  write_sketch(folder / "drawing.png", sketch);
  if (sketch.px_per_m) {
    write_atomically(folder / "drawing.yaml", map_server_text(*sketch.px_per_m));
  }
  write_jsonl(folder / "log.jsonl", data_set.run);
  write_reference(folder / "reference.csv", data_set.reference, sketch.height_px());
  write_tum(folder / "truth.tum", data_set.world_from_robot);
  if (const FloorPlan& plan = data_set.building.plan; has_racks(plan)) {
    write_labels(folder / "labels.csv", PlaceLabeller(plan).labels(data_set.world_from_robot));
  }
  write_path_picture(folder / "picture.png", sketch, path_in_sketch);
  write_atomically(folder / "run.yaml", run_file_text(made_by));
}

}  // namespace sketchloc
