// The steps of a run that localize wrote.

#include <stdexcept>

#include "eval/step_table.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sketchloc;
  const fuzz::InputFile input({data, size});
  try {
    const std::vector<StepReport> steps = read_step_table(input.path());
    fuzz::require(!steps.empty(), "a run has steps");
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const Estimate& estimate = steps[i].estimate;
      fuzz::require(i == 0 || steps[i].step > steps[i - 1].step, "steps increase");
      fuzz::require(estimate.sketch_from_robot.translation().allFinite(), "positions are finite");
      fuzz::require(estimate.sketch_from_robot.scale() > 0.0, "scales are above 0");
      fuzz::require(estimate.covariance.allFinite(), "covariances are finite");
    }
  } catch (const std::runtime_error&) {
  }
  return 0;
}
