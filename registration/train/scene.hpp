#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "datasets/grid.hpp"
#include "datasets/scan.hpp"
#include "datasets/sim/drive.hpp"
#include "datasets/sim/floor_plan.hpp"
#include "datasets/sim/lidar_model.hpp"
#include "datasets/sim/person.hpp"
#include "motion/random.hpp"
#include "motion/trajectory.hpp"
#include "registration/sketch_crop.hpp"
#include "registration/train/deformation_table.hpp"

namespace sketchloc {

/// What buildings, people and robots there are to learn from.
struct SceneParams {
  double human_share = 0.6;            ///< drawn as people do; the others as tps_person, in [0, 1]
  double home_share = 0.35;            ///< of the buildings, in [0, 1]
  double office_share = 0.4;           ///< the rest are warehouses; home_share + office_share <= 1
  double drive_m = 80.0;               ///< way through a building, > 0
  double min_field_of_view_rad = 3.1;  ///< of the scanners, in (0, 2 pi]
  double max_field_of_view_rad = 6.28;
  double min_max_range_m = 8.0;  ///< reach of the scanners, > 0
  double max_max_range_m = 30.0;
};

template <typename Visitor>
void visit_fields(SceneParams& scene, Visitor&& visit) {
  visit("human_share", scene.human_share);
  visit("home_share", scene.home_share);
  visit("office_share", scene.office_share);
  visit("drive_m", scene.drive_m);
  visit("min_field_of_view_rad", scene.min_field_of_view_rad);
  visit("max_field_of_view_rad", scene.max_field_of_view_rad);
  visit("min_max_range_m", scene.min_max_range_m);
  visit("max_max_range_m", scene.max_max_range_m);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const SceneParams& params);

/// A scanner with a random field of view, reach and noise.
LidarModel draw_lidar(const SceneParams& params, Rng& rng);

/// What a scanner saw on a drive, one scan for each pose.
std::vector<Scan> scan_drive(const LidarSimulator& lidar, const MetricTrajectory& drive, Rng& rng);

/// A building, a drawing of it and a robot that was driven through it, ready to cut samples from.
class Scene {
 public:
  Scene(const SceneParams& params, Rng& rng);

  const SketchCropper& sketch() const { return sketch_; }
  const DeformationTable& sketch_from_world() const { return sketch_from_world_; }
  const MetricTrajectory& drive() const { return drive_; }
  std::span<const Scan> scans() const { return scans_; }  ///< one per pose of the drive
  /// A scan from any free place, with noise.
  Scan scan(const Se2& world_from_robot, Rng& rng) const {
    return lidar_.scan(world_from_robot, 0.0, rng);
  }
  /// Whether a place is inside of the building, walls included.
  bool indoors(const Eigen::Vector2d& point_in_world) const;

 private:
  struct Made;
  explicit Scene(Made made, Rng& rng);
  static Made make(const SceneParams& params, Rng& rng);

  SketchCropper sketch_;
  DeformationTable sketch_from_world_;
  MetricTrajectory drive_;
  LidarSimulator lidar_;
  std::vector<Scan> scans_;
  Eigen::Vector2d origin_in_world_;
  Grid<std::uint8_t> indoors_;
};

}  // namespace sketchloc
