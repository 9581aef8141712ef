#include "smoothing/lag_smoother.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "motion/validate.hpp"

namespace sketchloc {
namespace {

/// Of being right, as a filter states it for the poses that it believes in.
double log_odds(std::span<const PoseHypothesis> believed) {
  constexpr double kLeast = 1e-3;
  double sum = 0.0;
  for (const PoseHypothesis& one : believed) {
    sum += one.inlier_probability;
  }
  const double probability = std::clamp(sum, kLeast, 1.0 - kLeast);
  return std::log(probability / (1.0 - probability));
}

}  // namespace

void validate(const LagParams& params) {
  require_above("lag_m", params.lag_m, 0.0);
  require_above("memory_m", params.memory_m, 0.0);
  require_above("back_every_m", params.back_every_m, 0.0);
  require_above("back_m", params.back_m, 0.0);
  require_above("back_on_log_odds", params.back_on_log_odds, 0.0);
  validate_part("hindsight", params.hindsight);
  require_at_least("max_behind", params.max_behind, 1);
}

void validate(const LagSmootherParams& params) {
  validate_part("lag", params.lag);
  validate_part("keyframes", params.keyframes);
  validate_part("smoothing", params.smoothing);
  require_in_range("max_modes", params.max_modes, 1, 16);
}

LagSmoother::LagSmoother(LagSmootherParts parts, const LagSmootherParams& params,
                         const std::optional<Sim2>& start_sketch_from_robot)
    : params_((validate(params), params)),
      step_back_(std::move(parts.step_back)),
      window_(parts.drawing, parts.predictor, params.keyframes, params.lag.hindsight),
      start_sketch_from_robot_(start_sketch_from_robot) {}

void LagSmoother::add(const RunStep& step, std::span<const PoseHypothesis> believed) {
  const bool is_keyframe = window_.add(step, believed);
  waiting_.push_back({.step = steps_++,
                      .time_s = step.scan.time_s,
                      .way_m = window_.way_m(),
                      .odom_from_robot = step.odom_from_robot});
  if (!is_keyframe) {
    return;
  }
  const std::size_t newest = window_.end() - 1;
  tasks_.push_back({.kind = Task::Kind::LookAsItCame, .keyframe = newest});
  next_to_look_back_ = std::max(next_to_look_back_, window_.first());
  while (next_to_look_back_ < newest && window_.saw_all_after(next_to_look_back_)) {
    tasks_.push_back({.kind = Task::Kind::LookBack, .keyframe = next_to_look_back_++});
  }
  if (window_.way_m() - went_back_at_m_ >= params_.lag.back_every_m) {
    tasks_.push_back({.kind = Task::Kind::GoBack, .keyframe = newest});
    went_back_at_m_ = window_.way_m();
  }
  tasks_.push_back({.kind = Task::Kind::Smooth, .keyframe = newest});
}

void LagSmoother::look_at_the_rest() {
  while (work()) {
  }
  for (; next_to_look_back_ < window_.end(); ++next_to_look_back_) {
    do_task({.kind = Task::Kind::LookBack, .keyframe = next_to_look_back_});
  }
}

KeyframeRun LagSmoother::known() {
  look_at_the_rest();
  const std::span<const Keyframe> keyframes = window_.keyframes();
  return {.start_sketch_from_robot = start_sketch_from_robot_,
          .start_probability = start_probability_,
          .keyframes = {keyframes.begin(), keyframes.end()}};
}

void LagSmoother::finish() {
  look_at_the_rest();
  if (window_.first() < window_.end()) {
    smooth_until(window_.end() - 1, std::numeric_limits<double>::infinity());
  }
}

bool LagSmoother::work() {
  while (!tasks_.empty()) {
    const Task task = tasks_.front();
    const bool is_spared = task.kind != Task::Kind::LookAsItCame && is_behind();
    const bool is_done = is_spared || do_task(task);
    if (is_done) {
      going_back_.reset();
      tasks_.pop_front();
    }
    if (!is_spared) {
      return true;
    }
  }
  return false;
}

/// Whether so many keyframes wait that the older ones' work has to be left out.
bool LagSmoother::is_behind() const {
  return std::ranges::count(tasks_, Task::Kind::Smooth, &Task::kind) > params_.lag.max_behind;
}

std::vector<LaggedPose> LagSmoother::take() { return std::exchange(found_, {}); }

/// Does a bit of a task; false: it goes on.
bool LagSmoother::do_task(const Task& task) {
  if (task.keyframe < window_.first()) {
    return true;
  }
  switch (task.kind) {
    case Task::Kind::LookAsItCame:
      window_.look_as_it_came(task.keyframe);
      return true;
    case Task::Kind::LookBack: {
      std::vector<Sim2> priors;
      for (const PoseHypothesis& one : window_.believed_at(task.keyframe)) {
        priors.push_back(one.sketch_from_robot);
      }
      window_.look_back(task.keyframe, priors);
      return true;
    }
    case Task::Kind::GoBack:
      return go_back(task.keyframe);
    case Task::Kind::Smooth:
      smooth_until(task.keyframe, window_.way_m(task.keyframe) - params_.lag.lag_m);
      return true;
  }
  return true;
}

bool LagSmoother::goes_on(std::size_t from, std::size_t keyframe) const {
  const double back_m = window_.way_m(from) - window_.way_m(keyframe);
  const bool knew_less = log_odds(window_.believed_at(keyframe)) + params_.lag.back_on_log_odds <
                         log_odds(window_.believed_at(from));
  return back_m <= params_.lag.lag_m && (back_m <= params_.lag.back_m || knew_less);
}

/// Steps a filter back by a scan, and registers where that was a keyframe's, once the scans after
/// it are all there; true where it has gone far enough.
bool LagSmoother::go_back(std::size_t from) {
  const bool begins = !going_back_;
  if (begins) {
    going_back_ = {.next_scan = window_.scan_of(from), .next_keyframe = from};
  }
  auto& [scan, keyframe] = *going_back_;
  const std::vector<Sim2> poses = step_back_(
      window_.scans_until(from)[scan],
      begins ? std::optional(window_.believed_at(from).front().sketch_from_robot) : std::nullopt);
  if (scan == window_.scan_of(keyframe)) {
    if (window_.saw_all_after(keyframe)) {
      window_.look_back(keyframe, poses);
    }
    if (keyframe == window_.first() || !goes_on(from, keyframe)) {
      return true;
    }
    --keyframe;
  }
  --scan;
  return false;
}

SmoothedRun LagSmoother::smoothed(const KeyframeRun& run) const {
  SmoothedRun result = smooth(run, params_.smoothing);
  if (result.status == SmoothedRun::Status::NoEvidence) {
    for (std::size_t k = 0; k < run.keyframes.size(); ++k) {
      const PoseHypothesis& believed = window_.believed_at(window_.first() + k).front();
      result.poses.push_back({.sketch_from_robot = believed.sketch_from_robot,
                              .covariance = covariance_in_sketch(believed),
                              .probability = believed.inlier_probability});
    }
  }
  return result;
}

void LagSmoother::smooth_until(std::size_t keyframe, double until_way_m) {
  const bool is_any_due = !waiting_.empty() && waiting_.front().way_m <= until_way_m;
  if (!is_any_due) {
    return;
  }
  const auto until = window_.keyframes().first(keyframe + 1 - window_.first());
  const KeyframeRun run{.start_sketch_from_robot = start_sketch_from_robot_,
                        .start_probability = start_probability_,
                        .keyframes = {until.begin(), until.end()}};
  const SmoothedRun result = smoothed(run);
  give_out(run, result.poses, until_way_m);
  forget_before(until_way_m - params_.lag.memory_m, result.poses);
}

void LagSmoother::give_out(const KeyframeRun& run, std::span<const SmoothedPose> poses,
                           double until_way_m) {
  std::size_t last = 0;
  while (!waiting_.empty() && waiting_.front().way_m <= until_way_m) {
    const Instant& now = waiting_.front();
    while (last + 1 < run.keyframes.size() && run.keyframes[last + 1].step <= now.step) {
      ++last;
    }
    SmoothedPose pose = poses[last];
    pose.sketch_from_robot = carried_pose(run, poses, now.step, now.odom_from_robot);
    found_.push_back({.step = now.step,
                      .time_s = now.time_s,
                      .way_m = window_.way_m() - now.way_m,
                      .pose = pose});
    waiting_.pop_front();
  }
}

/// The window goes on from a pose that has been given out, which is known as well as that was.
void LagSmoother::forget_before(double way_m, std::span<const SmoothedPose> poses) {
  std::size_t first = window_.first();
  while (first + 1 < window_.end() && window_.way_m(first + 1) <= way_m) {
    ++first;
  }
  if (first > window_.first()) {
    const SmoothedPose& pose = poses[first - window_.first()];
    start_sketch_from_robot_ = pose.sketch_from_robot;
    start_probability_ = pose.probability;
    window_.forget_before(first);
  }
}

}  // namespace sketchloc
