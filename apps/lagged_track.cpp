#include "apps/lagged_track.hpp"

#include <utility>

#include "apps/track_lines.hpp"
#include "eval/smoothed_localization.hpp"

namespace sketchloc {

LaggedTrack::LaggedTrack(const Sketch& sketch, WarpPredictor& predictor,
                         const LocalizerParams& localizer, const LagSmootherParams& params)
    : drawing_(sketch),
      predictor_(&predictor),
      step_back_(filter_back(sketch, localizer, predictor, params.max_modes)),
      params_(params) {}

void LaggedTrack::hear(const RunStep& step, const TrackedScan& tracked) {
  const StepReport& report = tracked.report;
  if (tracked.unmeasured_s) {
    finish();
  }
  if (!smoother_) {
    const bool is_known = report.localized_probability > 0.5;
    smoother_.emplace(
        LagSmootherParts{.drawing = drawing_, .predictor = *predictor_, .step_back = step_back_},
        params_, is_known ? std::optional(report.estimate.sketch_from_robot) : std::nullopt);
    first_step_ = report.step;
  }
  smoother_->add(step, believed_by(report, params_.max_modes));
}

void LaggedTrack::finish() {
  if (smoother_) {
    smoother_->finish();
    keep_lines();
    smoother_.reset();
  }
}

void LaggedTrack::keep_lines() {
  for (LaggedPose& pose : smoother_->take()) {
    pose.step += first_step_;
    lines_.push_back(lagged_line(pose));
  }
}

std::vector<std::string> LaggedTrack::take_lines() {
  if (smoother_) {
    keep_lines();
  }
  return std::exchange(lines_, {});
}

}  // namespace sketchloc
