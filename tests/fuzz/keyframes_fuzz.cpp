// The keyframes of a run that localize --smooth wrote.

#include <stdexcept>

#include "eval/keyframe_io.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sketchloc;
  const fuzz::InputFile input({data, size});
  try {
    const KeyframeRun run = read_keyframes(input.path());
    fuzz::require(!run.keyframes.empty(), "a run has keyframes");
    for (std::size_t k = 0; k < run.keyframes.size(); ++k) {
      const Keyframe& keyframe = run.keyframes[k];
      fuzz::require(k == 0 || keyframe.step > run.keyframes[k - 1].step, "steps increase");
      fuzz::require(keyframe.way_m >= 0.0 && keyframe.turn_rad >= 0.0, "nobody drives less than 0");
      for (const PoseHypothesis& one : keyframe.hypotheses) {
        fuzz::require(one.sketch_from_robot.scale() > 0.0, "scales are above 0");
        fuzz::require(one.covariance.allFinite(), "covariances are finite");
      }
    }
  } catch (const std::runtime_error&) {
  }
  return 0;
}
