#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "motion/se2.hpp"
#include "registration/spline_basis.hpp"
#include "registration/tps.hpp"
#include "smoothing/keyframe.hpp"
#include "smoothing/smooth.hpp"

namespace sketchloc {

/// How one spline for the whole drawing is looked for (docs/smoothing.md).
struct DrawingSplineParams {
  double spacing_m = 2.0;          ///< of the control points at least, > 0
  int max_controls = 150;          ///< else they lie wider apart, in [9, 1000]
  double margin_m = 5.0;           ///< of the control grid beyond the way, >= 0
  double slip_m = 0.01;            ///< of odometry after one metre, 1-sigma, > 0
  double turn_rad = 0.003;         ///< of its heading, > 0
  double turn_rad_per_rad = 0.01;  ///< the same for turns, >= 0
  double independent_way_m = 2.0;  ///< after which a registration sees other things, > 0
  double freedom = 4.0;            ///< of the Student t of what a keyframe's registrations say, > 0
  RobustKernel kernel{.shape = KernelShape::Dcs, .width = 1.7};  ///< of registrations of one
  int max_rounds = 30;  ///< of fitting and weighing, in [1, 1000]
};

template <typename Visitor>
void visit_fields(DrawingSplineParams& params, Visitor&& visit) {
  visit("spacing_m", params.spacing_m);
  visit("max_controls", params.max_controls);
  visit("margin_m", params.margin_m);
  visit("slip_m", params.slip_m);
  visit("turn_rad", params.turn_rad);
  visit("turn_rad_per_rad", params.turn_rad_per_rad);
  visit("independent_way_m", params.independent_way_m);
  visit("freedom", params.freedom);
  visit("kernel", params.kernel);
  visit("max_rounds", params.max_rounds);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const DrawingSplineParams& params);

/// One map from metres to the whole drawing, with the metric trajectory that belongs to it. Frame
/// `metric`: metres, in which the first keyframe has its odometry's pose and nothing drifts.
struct DrawingSpline {
  ThinPlateSpline sketch_from_metric;  ///< with its Jacobian in px/m
  SplineBasis basis;                   ///< over the same control points
  Eigen::MatrixXd covariance;  ///< of their places, px^2: all x, then all y; poses integrated out
  std::vector<Se2> metric_from_robot;  ///< one per keyframe
  double residual_m = 0.0;  ///< RMS distance of what keyframes' registrations say from the spline
  double effective_parameters = 0.0;  ///< bends that the data hold, of 2 (controls - 3)
  double noise_factor = 1.0;  ///< by which registrations err more than they state, as a variance
  bool converged = false;     ///< the weights; else they are those of the last round

  /// The robot's pose at a keyframe: position, rotation of the Jacobian's polar decomposition,
  /// sqrt(det). None where the spline folds there.
  std::optional<Sim2> sketch_from_robot(std::size_t keyframe) const;

  /// 1-sigma of the place of a point in the drawing, in local metres, along its worse axis.
  double sigma_m(const Eigen::Vector2d& point) const;
};

/// Finds trajectory and spline together: odometry between the keyframes, what registrations at each
/// say around its smoothed pose, and bending energy as the prior, whose weight the data choose
/// (evidence, [MacKay92]), as they choose how much more registrations err than they state. None
/// where the run is too short for a plane (the keyframes span less than `spacing_m`), or the
/// smoothed poses fit no map that does not fold.
std::optional<DrawingSpline> fit_drawing_spline(const KeyframeRun& run,
                                                std::span<const SmoothedPose> smoothed,
                                                const DrawingSplineParams& params = {});

}  // namespace sketchloc
