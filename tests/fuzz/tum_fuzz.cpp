// TUM trajectories.

#include <cmath>
#include <stdexcept>

#include "datasets/io/trajectory_io.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sketchloc;
  const fuzz::InputFile input({data, size});
  try {
    for (const Stamped<Se2>& stamped : read_tum(input.path())) {
      fuzz::require(std::isfinite(stamped.time_s), "times are finite");
      fuzz::require(stamped.pose.translation().allFinite(), "positions are finite");
      fuzz::require(std::isfinite(stamped.pose.yaw_rad()), "headings are finite");
    }
  } catch (const std::runtime_error&) {
  }
  return 0;
}
