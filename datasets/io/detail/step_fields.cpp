#include "datasets/io/detail/step_fields.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "datasets/io/detail/columns.hpp"
#include "datasets/io/detail/limits.hpp"

namespace sketchloc::detail {
namespace {

/// Ranges in metres; null is no return.
std::vector<float> read_ranges(const JsonFields& scan) {
  const nlohmann::json& array = scan.array("ranges_m");
  if (array.empty() || array.size() > kMostReadings) {
    fail_expected(scan.place(), scan.path_of("ranges_m"),
                  "1 to " + std::to_string(kMostReadings) + " values", std::to_string(array.size()),
                  "leave out scans without readings");
  }
  std::vector<float> ranges_m;
  ranges_m.reserve(array.size());
  for (const nlohmann::json& item : array) {
    if (item.is_null()) {
      ranges_m.push_back(std::numeric_limits<float>::quiet_NaN());
      continue;
    }
    const std::optional<double> range_m =
        item.is_number() ? std::optional(item.get<double>()) : std::nullopt;
    if (!is_within(range_m, kMostRange_m)) {
      fail_expected(scan.place(), scan.path_of("ranges_m[" + std::to_string(ranges_m.size()) + "]"),
                    number_within(kMostRange_m) + " or null", in_words(item), "correct the value");
    }
    ranges_m.push_back(static_cast<float>(*range_m));
  }
  return ranges_m;
}

}  // namespace

Se2 read_json_pose(const JsonFields& fields, std::string_view key) {
  const JsonFields pose = fields.object(key, {"x_m", "y_m", "yaw_rad"});
  return Se2::from_xy_yaw(pose.number("x_m", kMostPosition_m), pose.number("y_m", kMostPosition_m),
                          pose.number("yaw_rad", kMostAngle_rad));
}

Scan read_json_scan(const JsonFields& step) {
  const JsonFields fields = step.object("scan", {"first_angle_rad", "angle_step_rad", "min_range_m",
                                                 "max_range_m", "ranges_m", "robot_from_laser"});
  Scan scan;
  scan.time_s = step.number("time_s", kMostTime_s);
  scan.first_angle_rad = fields.number("first_angle_rad", kMostBeamAngle_rad);
  scan.angle_step_rad = fields.number("angle_step_rad", kMostBeamAngle_rad);
  scan.max_range_m = fields.number("max_range_m", kMostRange_m);
  if (fields.has("min_range_m")) {
    scan.min_range_m = fields.number("min_range_m", kMostRange_m);
  }
  if (fields.has("robot_from_laser")) {
    scan.robot_from_laser = read_json_pose(fields, "robot_from_laser");
  }
  if (scan.min_range_m < 0.0 || scan.max_range_m <= scan.min_range_m) {
    fail(step.place(), "scan: expected 0 <= min_range_m < max_range_m, found " +
                           std::to_string(scan.min_range_m) + " and " +
                           std::to_string(scan.max_range_m) + "; correct the values");
  }
  scan.ranges_m = read_ranges(fields);
  return scan;
}

}  // namespace sketchloc::detail
