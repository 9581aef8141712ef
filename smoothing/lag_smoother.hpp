#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "smoothing/keyframe_window.hpp"
#include "smoothing/smooth.hpp"

namespace sketchloc {

/// How far behind the robot its poses are smoothed.
struct LagParams {
  double lag_m = 10.0;        ///< way from a pose to where it is given out, > 0
  double memory_m = 20.0;     ///< way before that which has a say too, > 0
  double back_every_m = 2.5;  ///< way between the filters that go back, > 0
  double back_m = 10.0;       ///< how far they go, at most through the lag, > 0
  /// And on, for as long as the filter's log odds of being right were less than where it starts, by
  /// this, > 0: where a lost robot has been found, one wants to know it for the way before too.
  double back_on_log_odds = 3.0;
  HindsightParams hindsight;
  int max_behind = 4;  ///< keyframes that may wait before work is left out, >= 1
};

template <typename Visitor>
void visit_fields(LagParams& params, Visitor&& visit) {
  visit("lag_m", params.lag_m);
  visit("memory_m", params.memory_m);
  visit("back_every_m", params.back_every_m);
  visit("back_m", params.back_m);
  visit("back_on_log_odds", params.back_on_log_odds);
  visit("hindsight", params.hindsight);
  visit("max_behind", params.max_behind);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const LagParams& params);

/// All that a smoother with a lag is told.
struct LagSmootherParams {
  LagParams lag;
  KeyframeParams keyframes;
  SmoothingParams smoothing;
  int max_modes = 2;  ///< of the filter, registered at each keyframe, in [1, 16]
};

template <typename Visitor>
void visit_fields(LagSmootherParams& params, Visitor&& visit) {
  visit("lag", params.lag);
  visit("keyframes", params.keyframes);
  visit("smoothing", params.smoothing);
  visit("max_modes", params.max_modes);
}

/// Throws std::invalid_argument naming the component and field, its range and its value.
void validate(const LagSmootherParams& params);

/// A filter that goes back through scans: takes the next one back, and gives the poses that it
/// believes in, the likeliest first. It begins anew wherever it is given a start.
using StepBack = std::function<std::vector<Sim2>(const RunStep&, const std::optional<Sim2>& start)>;

/// What a smoother with a lag works with. The predictor must outlive it.
struct LagSmootherParts {
  const SketchCropper& drawing;
  WarpPredictor& predictor;
  StepBack step_back;
};

/// Where the robot was, a lag ago.
struct LaggedPose {
  std::size_t step = 0;  ///< counted from the first scan on
  double time_s = 0.0;
  double way_m = 0.0;  ///< driven since then when the pose was found
  SmoothedPose pose;
};

/// Smooths a run while it is driven: the pose of an instant is given out once the robot is a way
/// beyond it, with all that it has seen by then. From where the filter believes to be, another one
/// goes back through that way (docs/smoothing.md). Online: the memory is bounded by the way of lag
/// and memory; the work is done bit by bit, so that it fits between scans.
class LagSmoother {
 public:
  /// Throws std::invalid_argument if a parameter is out of range.
  LagSmoother(LagSmootherParts parts, const LagSmootherParams& params,
              const std::optional<Sim2>& start_sketch_from_robot);

  /// Takes the present scan, with odometry as good as matched_odometry's, and what a filter
  /// believes now, the likeliest first, not empty.
  void add(const RunStep& step, std::span<const PoseHypothesis> believed);

  /// No scans will come: the poses that are left are found with what there is.
  void finish();

  /// No scans will come: does what is left of the work, and gives all that is known of the way that
  /// is not forgotten, for one smoothing of the whole; a lag beyond the run's way forgets nothing.
  KeyframeRun known();

  bool has_work() const { return !tasks_.empty(); }

  /// Does the next bit: a keyframe's registrations, a step back, or a smoothing. False: there is
  /// nothing to do.
  bool work();

  /// The poses that were found since the last call, in order.
  std::vector<LaggedPose> take();

 private:
  struct Task {
    enum class Kind {
      LookAsItCame,
      LookBack,  ///< at a keyframe whose scans after it have come, from the filter's poses
      GoBack,    ///< from what the filter believed at a keyframe
      Smooth     ///< up to a keyframe
    };
    Kind kind = Kind::Smooth;
    std::size_t keyframe = 0;
  };
  struct Instant {
    std::size_t step = 0;
    double time_s = 0.0;
    double way_m = 0.0;
    Se2 odom_from_robot;
  };
  /// How far a filter has come on its way back.
  struct GoingBack {
    std::size_t next_scan = 0;      ///< of the window
    std::size_t next_keyframe = 0;  ///< the last one that it has not left behind
  };

  bool is_behind() const;
  bool do_task(const Task& task);
  void look_at_the_rest();
  bool go_back(std::size_t from);
  bool goes_on(std::size_t from, std::size_t keyframe) const;
  void smooth_until(std::size_t keyframe, double until_way_m);
  SmoothedRun smoothed(const KeyframeRun& run) const;
  void give_out(const KeyframeRun& run, std::span<const SmoothedPose> poses, double until_way_m);
  void forget_before(double way_m, std::span<const SmoothedPose> poses);

  LagSmootherParams params_;
  StepBack step_back_;
  KeyframeWindow window_;
  std::optional<Sim2> start_sketch_from_robot_;  ///< at the window's first keyframe
  double start_probability_ = 1.0;
  std::size_t next_to_look_back_ = 0;
  double went_back_at_m_ = 0.0;  ///< way where the last filter began to go back
  std::deque<Task> tasks_;
  std::optional<GoingBack> going_back_;
  std::deque<Instant> waiting_;  ///< instants whose poses have not been found yet
  std::size_t steps_ = 0;
  std::vector<LaggedPose> found_;
};

}  // namespace sketchloc
