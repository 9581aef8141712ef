#include "datasets/io/corrected_poses.hpp"

#include <cstddef>
#include <limits>
#include <string>

#include "datasets/io/detail/columns.hpp"
#include "datasets/io/detail/limits.hpp"
#include "datasets/io/detail/whole_lines.hpp"
#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

using namespace detail;

/// FLASER n r1..rn x y theta odom_x odom_y odom_theta time host logger_time
Stamped<Se2> parse_corrected(Columns& columns) {
  const std::int64_t count = columns.integer("num_readings", 1, kMostReadings);
  columns.skip(static_cast<std::size_t>(count), "range");
  const double x_m = columns.number("x", kMostPosition_m);
  const double y_m = columns.number("y", kMostPosition_m);
  const double yaw_rad = columns.number("theta", kMostAngle_rad);
  columns.skip(3, "odometry");
  return {.time_s = columns.number("time", kMostTime_s),
          .pose = Se2::from_xy_yaw(x_m, y_m, yaw_rad)};
}

}  // namespace

MetricTrajectory read_corrected_poses(const std::filesystem::path& log) {
  const RunReading reading;
  LineReader lines(log, text_limits(reading));
  MetricTrajectory world_from_robot;
  for_each_whole_line(lines, reading, [&](std::string_view line, const Place& place) {
    Columns columns = Columns::blank_separated(line, place);
    if (columns.at_end() || columns.text("keyword") != "FLASER") {
      return;
    }
    const Stamped<Se2> corrected = parse_corrected(columns);
    const double last_s = world_from_robot.empty()
                              ? -std::numeric_limits<double>::infinity()
                              : world_from_robot[world_from_robot.size() - 1].time_s;
    if (corrected.time_s < last_s) {
      fail_expected(place, "time", "at least " + number_text(last_s) + ", as of the scan before",
                    number_text(corrected.time_s), "remove the line");
    }
    if (corrected.time_s > last_s) {
      world_from_robot.append(corrected.time_s, corrected.pose);
    }
  });
  if (world_from_robot.empty()) {
    fail({.file = lines.place().file}, "scans: expected lines that start with FLASER, found none");
  }
  return world_from_robot;
}

}  // namespace sketchloc
