#include "datasets/io/trajectory_io.hpp"

#include <cmath>
#include <string>

#include "datasets/io/atomic_file.hpp"
#include "datasets/io/detail/columns.hpp"
#include "datasets/io/detail/limits.hpp"
#include "datasets/io/detail/line_reader.hpp"
#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

using detail::Columns;
using detail::Place;

constexpr std::string_view kSketchFrame = "# frame: sketch, px";
constexpr std::string_view kTumAdvice =
    "a run in a drawing is compared by evaluate --run DIR --reference REF.csv";
constexpr double kNormTolerance = 1e-2;  ///< some files have four decimals
constexpr double kTiltTolerance = 1e-3;  ///< of qx and qy, about 0.1 deg of roll or pitch

double read_yaw_rad(Columns& columns) {
  const double qx = columns.number("qx", 2.0);
  const double qy = columns.number("qy", 2.0);
  const double qz = columns.number("qz", 2.0);
  const double qw = columns.number("qw", 2.0);
  const double norm = std::sqrt(qx * qx + qy * qy + qz * qz + qw * qw);
  if (std::abs(norm - 1.0) > kNormTolerance) {
    detail::fail_expected(columns.place(), "quaternion", "a norm of 1", std::to_string(norm),
                          "the order is qx qy qz qw");
  }
  if (std::hypot(qx, qy) > kTiltTolerance) {
    detail::fail_expected(columns.place(), "quaternion", "a rotation about z only",
                          "qx " + std::to_string(qx) + ", qy " + std::to_string(qy),
                          "project the trajectory to the plane first");
  }
  return 2.0 * std::atan2(qz, qw);
}

/// Poses in the px of a drawing say so in a comment.
void refuse_sketch_frame(std::string_view comment, const Place& place) {
  if (comment.starts_with(kSketchFrame)) {
    detail::fail_expected(place, "frame", "a trajectory in metres", "poses in the px of a drawing",
                          kTumAdvice);
  }
}

Stamped<Se2> parse_pose(std::string_view line, const Place& place) {
  Columns columns = Columns::blank_separated(line, place);
  const double time_s = columns.number("t", detail::kMostTime_s);
  const double x_m = columns.number("x", detail::kMostPosition_m);
  const double y_m = columns.number("y", detail::kMostPosition_m);
  columns.number("z", detail::kMostPosition_m);
  const double yaw_rad = read_yaw_rad(columns);
  columns.expect_end();
  return {.time_s = time_s, .pose = Se2::from_xy_yaw(x_m, y_m, yaw_rad)};
}

void append_line(std::string& text, double time_s, const Eigen::Vector2d& position,
                 double yaw_rad) {
  append_number(text, time_s);
  for (const double value : {position.x(), position.y(), 0.0, 0.0, 0.0, std::sin(yaw_rad / 2.0),
                             std::cos(yaw_rad / 2.0)}) {
    text += ' ';
    append_number(text, value);
  }
  text += '\n';
}

template <typename Pose>
void write_lines(const std::filesystem::path& tum, std::string text,
                 const Trajectory<Pose>& trajectory) {
  for (const Stamped<Pose>& stamped : trajectory) {
    append_line(text, stamped.time_s, stamped.pose.translation(), stamped.pose.yaw_rad());
  }
  write_atomically(tum, text);
}

}  // namespace

MetricTrajectory read_tum(const std::filesystem::path& tum) {
  MetricTrajectory trajectory;
  const auto append = [&trajectory](std::string_view line, const Place& place) {
    if (trajectory.empty() && line.find(',') != std::string_view::npos) {
      detail::fail_expected(place, "poses", "t x y z qx qy qz qw, parted by blanks (TUM)",
                            "commas (a CSV file?)", kTumAdvice);
    }
    const Stamped<Se2> stamped = parse_pose(line, place);
    if (!trajectory.empty() && stamped.time_s <= trajectory[trajectory.size() - 1].time_s) {
      detail::fail_expected(place, "t", "a time after the one before",
                            std::to_string(stamped.time_s),
                            "put the lines in order and remove doubles");
    }
    trajectory.append(stamped.time_s, stamped.pose);
  };
  detail::for_each_data_line(tum, append, refuse_sketch_frame);
  if (trajectory.empty()) {
    detail::fail({.file = tum}, "poses: expected lines of t x y z qx qy qz qw, found none");
  }
  return trajectory;
}

void write_tum(const std::filesystem::path& tum, const MetricTrajectory& trajectory) {
  write_lines(tum, "# t_s x_m y_m z qx qy qz qw\n", trajectory);
}

void write_tum(const std::filesystem::path& tum, const SketchTrajectory& trajectory) {
  write_lines(
      tum, std::string(kSketchFrame) + "; y up, origin lower left\n# t_s x_px y_px z qx qy qz qw\n",
      trajectory);
}

}  // namespace sketchloc
