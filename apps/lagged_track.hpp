#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "datasets/sketch.hpp"
#include "filter/online/tracker.hpp"
#include "registration/sketch_crop.hpp"
#include "registration/warp_predictor.hpp"
#include "smoothing/lag_smoother.hpp"

namespace sketchloc {

/// The lagged poses of a robot that is tracked: a smoother beside the filter, and a line for each
/// pose that it gives out.
class LaggedTrack {
 public:
  /// The predictor must outlive it; the filter that goes back is as `localizer` says.
  LaggedTrack(const Sketch& sketch, WarpPredictor& predictor, const LocalizerParams& localizer,
              const LagSmootherParams& params);

  /// Takes a scan that was tracked, with its refined odometry. Where the odometry jumped before it,
  /// smoothing ends there and begins anew.
  void hear(const RunStep& step, const TrackedScan& tracked);

  bool has_work() const { return smoother_ && smoother_->has_work(); }
  bool work() { return smoother_ && smoother_->work(); }  ///< the next bit, see LagSmoother
  void finish();

  /// Of the poses that were found since the last call.
  std::vector<std::string> take_lines();

 private:
  void keep_lines();

  SketchCropper drawing_;
  WarpPredictor* predictor_;
  StepBack step_back_;
  LagSmootherParams params_;
  std::optional<LagSmoother> smoother_;
  std::size_t first_step_ = 0;  ///< of the smoother, as the filter counts
  std::vector<std::string> lines_;
};

}  // namespace sketchloc
