// CARMEN logs and JSON lines, plain or gzip. The first byte of the input is the choice of options.

#include <cmath>
#include <stdexcept>

#include "datasets/io/run_io.hpp"
#include "tests/fuzz/input_file.hpp"

namespace {

using namespace sketchloc;

void check_run(const Run& run) {
  fuzz::require(!run.steps.empty(), "a run has steps");
  double last_s = run.steps[0].scan.time_s;
  for (const RunStep& step : run.steps) {
    fuzz::require(step.scan.time_s >= last_s, "times do not decrease");
    fuzz::require(!step.scan.ranges_m.empty(), "a scan has readings");
    fuzz::require(step.odom_from_robot.translation().allFinite(), "odometry is finite");
    fuzz::require(std::isfinite(step.odom_from_robot.yaw_rad()), "headings are finite");
    fuzz::require(step.scan.robot_from_laser.translation().allFinite(), "mountings are finite");
    last_s = step.scan.time_s;
    const std::string line = json_line(step);
    fuzz::require(json_line(parse_json_step(line, "line", 1)).size() > 0, "steps survive JSON");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) {
    return 0;
  }
  const fuzz::InputFile input({data + 1, size - 1});
  RunReading reading{.allow_truncated = (data[0] & 1) != 0, .max_total_bytes = 1 << 22};
  if ((data[0] & 2) != 0) {
    reading.max_range_m = 10.0;
  }
  try {
    check_run(read_run(input.path(), reading));
  } catch (const std::runtime_error&) {
  }
  return 0;
}
