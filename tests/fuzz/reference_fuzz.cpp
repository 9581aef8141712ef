// Reference CSVs and those of alternative readings.

#include <cmath>
#include <stdexcept>

#include "datasets/io/reference_io.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sketchloc;
  const fuzz::InputFile input({data, size});
  try {
    for (const ReferencePose& pose : read_reference(input.path(), 100).poses) {
      fuzz::require(pose.sketch_from_robot.translation().allFinite(), "positions are finite");
      fuzz::require(std::isfinite(pose.sketch_from_robot.scale()), "scales are finite");
      fuzz::require(pose.uncertainty_m >= 0.0, "uncertainties are not negative");
    }
  } catch (const std::runtime_error&) {
  }
  try {
    for (const AlternativePose& pose : read_alternative(input.path(), 100)) {
      fuzz::require(pose.distance_px >= 0.0, "distances are not negative");
    }
  } catch (const std::runtime_error&) {
  }
  return 0;
}
