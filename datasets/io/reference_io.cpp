#include "datasets/io/reference_io.hpp"

#include "datasets/io/atomic_file.hpp"
#include "datasets/io/csv_table.hpp"
#include "datasets/io/detail/limits.hpp"
#include "motion/check.hpp"
#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

using detail::kMostAngle_rad;
using detail::kMostPosition_m;
using detail::kMostPosition_px;
using detail::kMostTime_s;

/// Image: origin at the centre of the top left pixel, y down, heading clockwise.
Sim2 sketch_from_robot(double x_image_px, double y_image_px, double heading_image_rad,
                       double scale_px_per_m, int sketch_height_px) {
  return Sim2::from_xy_yaw_scale(x_image_px + 0.5, sketch_height_px - 0.5 - y_image_px,
                                 -heading_image_rad, scale_px_per_m);
}

Sim2 sketch_from_robot(const CsvRow& row, std::string_view heading_column, int sketch_height_px) {
  return sketch_from_robot(
      row.number("sketch_x_px", kMostPosition_px), row.number("sketch_y_px", kMostPosition_px),
      row.number(heading_column, kMostAngle_rad),
      row.above_zero("local_scale_px_per_m", kMostPosition_px), sketch_height_px);
}

/// The columns of write_reference that our reference does not know are "nan".
void append_row(std::string& text, const ReferencePose& pose, int sketch_height_px) {
  const Sim2& sketch_from_robot = pose.sketch_from_robot;
  const double heading_image_rad = -sketch_from_robot.yaw_rad();
  text += std::to_string(pose.step);
  for (const double value :
       {pose.time_s, sketch_from_robot.x() - 0.5, sketch_height_px - 0.5 - sketch_from_robot.y(),
        heading_image_rad, heading_image_rad, sketch_from_robot.scale(), pose.uncertainty_m}) {
    text += ',';
    append_number(text, value);
  }
  text += pose.scored ? ",nan,nan,1,1,nan\n" : ",nan,nan,0,0,nan\n";
}

template <typename Pose>
void append_in_order(std::vector<Pose>& poses, Pose pose, const CsvRow& row) {
  if (!poses.empty() && pose.step <= poses.back().step) {
    row.fail("t_index", "more than " + std::to_string(poses.back().step),
             "put the rows in order, one for each scan");
  }
  poses.push_back(std::move(pose));
}

}  // namespace

Reference read_reference(const std::filesystem::path& csv, int sketch_height_px) {
  check(sketch_height_px > 0, "a drawing has a height");
  Reference reference;
  for_each_csv_row(
      csv,
      {"t_index", "t", "sketch_x_px", "sketch_y_px", "heading_rigid_rad", "local_scale_px_per_m",
       "loo_uncertainty_m", "in_image", "in_hull"},
      [&](const CsvRow& row) {
        const bool in_image = row.flag("in_image");
        const bool in_hull = row.flag("in_hull");
        ReferencePose pose{
            .step = row.index("t_index"),
            .time_s = row.number("t", kMostTime_s),
            .sketch_from_robot = sketch_from_robot(row, "heading_rigid_rad", sketch_height_px),
            .uncertainty_m = row.at_least_zero("loo_uncertainty_m", kMostPosition_m),
            .scored = in_image && in_hull};
        append_in_order(reference.poses, std::move(pose), row);
      });
  return reference;
}

std::vector<AlternativePose> read_alternative(const std::filesystem::path& csv,
                                              int sketch_height_px) {
  check(sketch_height_px > 0, "a drawing has a height");
  std::vector<AlternativePose> poses;
  for_each_csv_row(
      csv,
      {"t_index", "t", "sketch_x_px", "sketch_y_px", "heading_rad", "local_scale_px_per_m",
       "distance_to_A_px"},
      [&](const CsvRow& row) {
        AlternativePose pose{
            .step = row.index("t_index"),
            .time_s = row.number("t", kMostTime_s),
            .sketch_from_robot = sketch_from_robot(row, "heading_rad", sketch_height_px),
            .distance_px = row.at_least_zero("distance_to_A_px", kMostPosition_px)};
        append_in_order(poses, std::move(pose), row);
      });
  return poses;
}

void write_reference(const std::filesystem::path& csv, const Reference& reference,
                     int sketch_height_px) {
  check(sketch_height_px > 0, "a drawing has a height");
  std::string text =
      "t_index,t,sketch_x_px,sketch_y_px,heading_rad,heading_rigid_rad,local_scale_px_per_m,"
      "loo_uncertainty_m,local_rotation_deg_yup,anisotropy,in_image,in_hull,"
      "dist_nearest_correspondence_m\n";
  for (const ReferencePose& pose : reference.poses) {
    append_row(text, pose, sketch_height_px);
  }
  write_atomically(csv, text);
}

}  // namespace sketchloc
