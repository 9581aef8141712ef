#include "datasets/io/detail/carmen.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>

#include "datasets/io/detail/columns.hpp"
#include "datasets/io/detail/limits.hpp"
#include "datasets/io/detail/whole_lines.hpp"
#include "motion/number_text.hpp"
#include "motion/trajectory.hpp"

namespace sketchloc {
namespace detail {
namespace {

constexpr double kDefaultMaxRange_m = 80.0;
constexpr double kOdometryHold_s = 1.0;  ///< a scan this far outside the ODOM lines keeps the end

struct CarmenLog {
  std::optional<double> front_laser_max_m;  ///< PARAM
  std::vector<RunStep> front_laser;         ///< FLASER
  std::vector<RunStep> robot_laser;         ///< ROBOTLASER1
  std::vector<std::size_t> robot_laser_lines;
  std::vector<Stamped<Se2>> odometry;  ///< ODOM
};

Se2 read_pose(Columns& columns, const std::string& name) {
  const double x_m = columns.number(name + "x", kMostPosition_m);
  const double y_m = columns.number(name + "y", kMostPosition_m);
  return Se2::from_xy_yaw(x_m, y_m, columns.number(name + "theta", kMostAngle_rad));
}

/// "time host logger_time", with which every CARMEN message ends.
double read_time(Columns& columns) {
  const double time_s = columns.number("time", kMostTime_s);
  columns.text("host");
  columns.number("logger_time", kMostTime_s);
  columns.expect_end();
  return time_s;
}

std::vector<float> read_ranges(Columns& columns) {
  const auto count = static_cast<std::size_t>(columns.integer("num_readings", 1, kMostReadings));
  std::vector<float> ranges_m;
  ranges_m.reserve(count);
  for (std::size_t beam = 0; beam < count; ++beam) {
    if (columns.at_end()) {
      fail_expected(columns.place(), "ranges", std::to_string(count) + " values",
                    std::to_string(beam), "the line is too short: complete it or remove it");
    }
    const std::string_view column = columns.text("range");
    const std::optional<double> range_m = parse_number<double>(column);
    if (!is_within(range_m, kMostRange_m)) {
      fail_expected(columns.place(), "range " + std::to_string(beam), number_within(kMostRange_m),
                    in_quotes(column), "correct the value or remove the line");
    }
    ranges_m.push_back(static_cast<float>(*range_m));
  }
  return ranges_m;
}

/// FLASER n r1..rn x y theta odom_x odom_y odom_theta time host logger_time: 180 degrees from
/// right to left. The first pose may be corrected by a mapper, so only the second one is used.
RunStep parse_front_laser(Columns& columns) {
  RunStep step;
  Scan& scan = step.scan;
  scan.ranges_m = read_ranges(columns);
  const std::size_t count = scan.ranges_m.size();
  const std::size_t steps = count % 2 == 1 && count > 1 ? count - 1 : count;
  scan.first_angle_rad = -std::numbers::pi / 2;
  scan.angle_step_rad = std::numbers::pi / static_cast<double>(steps);
  read_pose(columns, "");
  step.odom_from_robot = read_pose(columns, "odom_");
  scan.time_s = read_time(columns);
  return step;
}

/// ROBOTLASER1 type start_angle fov resolution max_range accuracy remission_mode n r1..rn
/// m e1..em laser_pose robot_pose tv rv forward_safety side_safety turn_axis time host logger_time.
RunStep parse_robot_laser(Columns& columns) {
  RunStep step;
  Scan& scan = step.scan;
  columns.skip(1, "laser_type");
  scan.first_angle_rad = columns.number("start_angle", kMostBeamAngle_rad);
  columns.number("field_of_view", kMostBeamAngle_rad);
  scan.angle_step_rad = columns.number("angular_resolution", kMostBeamAngle_rad);
  scan.max_range_m = columns.number("maximum_range", kMostRange_m);
  columns.number("accuracy", kMostRange_m);
  columns.skip(1, "remission_mode");
  scan.ranges_m = read_ranges(columns);
  const std::int64_t remissions = columns.integer("num_remissions", 0, kMostReadings);
  columns.skip(static_cast<std::size_t>(remissions), "remission");
  const Se2 odom_from_laser = read_pose(columns, "laser_pose_");
  step.odom_from_robot = read_pose(columns, "robot_pose_");
  scan.robot_from_laser = step.odom_from_robot.inverse() * odom_from_laser;
  for (const char* field :
       {"laser_tv", "laser_rv", "forward_safety_dist", "side_safety_dist", "turn_axis"}) {
    columns.number(field, kMostPosition_m);
  }
  scan.time_s = read_time(columns);
  if (!(scan.max_range_m > 0.0)) {
    fail_expected(columns.place(), "maximum_range", "a number above 0",
                  std::to_string(scan.max_range_m), "correct the value");
  }
  return step;
}

/// ODOM x y theta tv rv accel time host logger_time
Stamped<Se2> parse_odometry(Columns& columns) {
  const Se2 odom_from_robot = read_pose(columns, "");
  columns.number("tv", kMostPosition_m);
  columns.number("rv", kMostPosition_m);
  columns.number("accel", kMostPosition_m);
  return {.time_s = read_time(columns), .pose = odom_from_robot};
}

std::optional<double> parse_front_laser_max(Columns& columns) {
  const std::string_view name = columns.text("param_name");
  if (name != "robot_front_laser_max" && name != "laser_front_laser_max") {
    return std::nullopt;
  }
  const double max_range_m = columns.number(name, kMostRange_m);
  if (!(max_range_m > 0.0)) {
    fail_expected(columns.place(), name, "a number above 0", std::to_string(max_range_m),
                  "correct the value");
  }
  return max_range_m;
}

void append_in_order(std::vector<RunStep>& steps, RunStep step, const Place& place) {
  expect_order_of_time(steps, step.scan.time_s, place);
  steps.push_back(std::move(step));
}

void parse_line(std::string_view line, const Place& place, CarmenLog& log) {
  Columns columns = Columns::blank_separated(line, place);
  if (columns.at_end()) {
    return;
  }
  const std::string_view keyword = columns.text("keyword");
  if (keyword == "FLASER") {
    append_in_order(log.front_laser, parse_front_laser(columns), place);
  } else if (keyword == "ROBOTLASER1") {
    append_in_order(log.robot_laser, parse_robot_laser(columns), place);
    log.robot_laser_lines.push_back(place.line);
  } else if (keyword == "ODOM") {
    log.odometry.push_back(parse_odometry(columns));
  } else if (keyword == "PARAM") {
    const std::optional<double> max_range_m = parse_front_laser_max(columns);
    log.front_laser_max_m = max_range_m ? max_range_m : log.front_laser_max_m;
  }
}

/// The odometry messages in order of time, the last one where several have the same time.
MetricTrajectory in_order_of_time(std::vector<Stamped<Se2>> odometry) {
  std::ranges::stable_sort(odometry, {}, &Stamped<Se2>::time_s);
  MetricTrajectory trajectory;
  for (std::size_t i = 0; i < odometry.size(); ++i) {
    if (i + 1 == odometry.size() || odometry[i].time_s < odometry[i + 1].time_s) {
      trajectory.append(odometry[i].time_s, odometry[i].pose);
    }
  }
  return trajectory;
}

Se2 odometry_at(const MetricTrajectory& odometry, double time_s, const Place& place) {
  const double first_s = odometry[0].time_s;
  const double last_s = odometry[odometry.size() - 1].time_s;
  if (time_s < first_s - kOdometryHold_s || time_s > last_s + kOdometryHold_s) {
    fail_expected(place, "time",
                  "a time covered by the ODOM lines (" + std::to_string(first_s) + " to " +
                      std::to_string(last_s) + " s)",
                  std::to_string(time_s) + " s",
                  "remove the scan, or all ODOM lines to use the robot poses of the scans");
  }
  return *odometry.at(std::clamp(time_s, first_s, last_s));
}

RunFile run_of_front_laser(CarmenLog log, const RunReading& reading) {
  const double max_range_m =
      reading.max_range_m.value_or(log.front_laser_max_m.value_or(kDefaultMaxRange_m));
  for (RunStep& step : log.front_laser) {
    step.scan.max_range_m = max_range_m;
  }
  RunFile file{.run = {std::move(log.front_laser)}, .notes = {}};
  if (!log.robot_laser.empty()) {
    file.notes.push_back("the log has FLASER and ROBOTLASER1 lines; only FLASER is read");
  }
  return file;
}

RunFile run_of_robot_laser(CarmenLog log, const RunReading& reading, const Place& place) {
  RunFile file;
  const MetricTrajectory odometry = in_order_of_time(std::move(log.odometry));
  file.notes.push_back(odometry.empty()
                           ? "no ODOM lines: the odometry is the robot pose of the ROBOTLASER1 "
                             "lines, which a mapper may have corrected"
                           : "the odometry is interpolated between the ODOM lines");
  for (std::size_t i = 0; i < log.robot_laser.size(); ++i) {
    RunStep& step = log.robot_laser[i];
    step.scan.max_range_m = reading.max_range_m.value_or(step.scan.max_range_m);
    if (!odometry.empty()) {
      step.odom_from_robot = odometry_at(odometry, step.scan.time_s,
                                         {.file = place.file, .line = log.robot_laser_lines[i]});
    }
  }
  file.run.steps = std::move(log.robot_laser);
  return file;
}

}  // namespace

RunFile read_carmen_lines(LineReader& lines, const RunReading& reading) {
  CarmenLog log;
  std::vector<std::string> notes = for_each_whole_line(
      lines, reading,
      [&log](std::string_view line, const Place& place) { parse_line(line, place, log); });
  if (log.front_laser.empty() && log.robot_laser.empty()) {
    fail({.file = lines.place().file},
         "scans: expected lines that start with FLASER or ROBOTLASER1, found none; is this a "
         "CARMEN log?");
  }
  RunFile file = log.front_laser.empty()
                     ? run_of_robot_laser(std::move(log), reading, lines.place())
                     : run_of_front_laser(std::move(log), reading);
  std::ranges::move(notes, std::back_inserter(file.notes));
  return file;
}

}  // namespace detail

RunFile read_carmen(const std::filesystem::path& log, const RunReading& reading) {
  validate(reading);
  detail::LineReader lines(log, detail::text_limits(reading));
  return detail::read_carmen_lines(lines, reading);
}

}  // namespace sketchloc
