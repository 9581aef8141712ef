#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "datasets/run.hpp"
#include "datasets/sketch.hpp"
#include "eval/place_pairs.hpp"
#include "eval/run_record.hpp"
#include "filter/localizer.hpp"
#include "registration/matched_odometry.hpp"
#include "registration/network_predictor.hpp"
#include "registration/odometry_feed.hpp"
#include "smoothing/drawing_spline.hpp"
#include "smoothing/keyframes.hpp"
#include "smoothing/lag_smoother.hpp"
#include "smoothing/smooth.hpp"

namespace sketchloc {

/// What finds the robot in the drawing.
enum class Method {
  Mcl,      ///< Monte Carlo localization
  Chained,  ///< one registration after the other, each from the last one's pose [Chen20]
  Odometry  ///< dead reckoning from the start: what the others must beat
};

/// Whether poses are smoothed (docs/smoothing.md).
enum class Smoothing {
  None,
  Lagged,  ///< as they would have been known a way later, while the robot drove
  Whole    ///< with all that the run showed
};

/// How a run is smoothed (docs/smoothing.md).
struct SmoothingPlan {
  KeyframeParams keyframes;
  SmoothingParams smoothing;
  int max_modes = 2;    ///< of each filter, registered at each keyframe, in [1, 16]
  bool places = false;  ///< keyframes of one place, told by the building's topology, are tied
  PlacePairParams place_pairs;
  LagParams lag;
  DrawingSplineParams spline;
};

template <typename Visitor>
void visit_fields(SmoothingPlan& plan, Visitor&& visit) {
  visit("keyframes", plan.keyframes);
  visit("smoothing", plan.smoothing);
  visit("max_modes", plan.max_modes);
  visit("places", plan.places);
  visit("place_pairs", plan.place_pairs);
  visit("lag", plan.lag);
  visit("spline", plan.spline);
}

/// Throws std::invalid_argument naming the component and field, its range and its value.
void validate(const SmoothingPlan& plan);

struct LocalizationParams {
  LocalizerParams localizer;
  MatchedOdometryParams odometry;
  NetworkPredictorParams predictor;
  double chain_way_m = 0.5;  ///< between registrations of a chain; between them odometry, >= 0
  SmoothingPlan smoothing;
};

template <typename Visitor>
void visit_fields(LocalizationParams& params, Visitor&& visit) {
  visit("localizer", params.localizer);
  visit("odometry", params.odometry);
  visit("predictor", params.predictor);
  visit("chain_way_m", params.chain_way_m);
  visit("smoothing", params.smoothing);
}

/// Throws std::invalid_argument naming the component and field, its range and its value.
void validate(const LocalizationParams& params);

struct LocalizationTask {
  Method method = Method::Mcl;
  OdometrySource odometry = OdometrySource::Matched;
  std::optional<Sim2> start_sketch_from_robot =
      std::nullopt;                       ///< none: anywhere in the drawing; MCL only
  WarpPredictor* predictor = nullptr;     ///< registers scans; a chain needs one
  Smoothing smoothing = Smoothing::None;  ///< else MCL with a predictor only
};

struct Localization {
  enum class Status {
    Done,
    EmptyRun,     ///< no steps
    NoFreeSpace,  ///< the drawing encloses nothing to start in
    NoReturns,    ///< no scan saw anything, so that nothing tells the drawing's scale
    NoStart       ///< dead reckoning and a chain need a start
  };
  Status status = Status::Done;
  std::vector<StepReport> steps;            ///< one per step of the run, if Done
  std::vector<ParticleSnapshot> snapshots;  ///< spread evenly over the run
  std::vector<StepReport> filtered = {};    ///< where it was smoothed: the filter's own steps
  KeyframeRun keyframes = {};               ///< what smoothing was made of
};

/// Localizes a whole run. `progress` hears the number of steps done after each one, of
/// steps_of_work() in all; it may throw to stop the work.
Localization localize(const Sketch& sketch, const Run& run, const LocalizationTask& task,
                      const LocalizationParams& params = {},
                      const std::function<void(std::size_t)>& progress = {});

/// A run that is smoothed is driven twice.
std::size_t steps_of_work(const Run& run, const LocalizationTask& task);

/// The local scale (px/m) at a place of the drawing, from how far a scan sees there and how far the
/// drawing lets it see: the median ratio over the beams. None where no beam tells.
std::optional<double> guess_px_per_m(const Sketch& sketch, const Eigen::Vector2d& place_in_sketch,
                                     double heading_rad, const Scan& scan);

}  // namespace sketchloc
