#pragma once

#include <optional>
#include <span>
#include <vector>

#include "smoothing/keyframe_window.hpp"

namespace sketchloc::testing {

/// A keyframe window in which nothing is ever registered.
class NoRegistrations {
 public:
  explicit NoRegistrations(const KeyframeParams& params) : window_(drawing_, none_, params, {}) {}

  void add(const RunStep& step) { window_.add(step, std::vector<PoseHypothesis>(1)); }
  std::span<const Keyframe> keyframes() const { return window_.keyframes(); }

 private:
  class None : public WarpPredictor {
   public:
    std::vector<std::optional<Registration>> predict(std::span<const PlacedScan>,
                                                     const SketchCropper&,
                                                     std::span<const Sim2> priors) override {
      return std::vector<std::optional<Registration>>(priors.size());
    }
  };

  SketchCropper drawing_{Grid<std::uint8_t>(20, 20)};
  None none_;
  KeyframeWindow window_;
};

/// The keyframes of a run, without hypotheses.
inline std::vector<Keyframe> keyframes_of(std::span<const RunStep> steps,
                                          const KeyframeParams& params = {}) {
  NoRegistrations window(params);
  for (const RunStep& step : steps) {
    window.add(step);
  }
  return {window.keyframes().begin(), window.keyframes().end()};
}

}  // namespace sketchloc::testing
