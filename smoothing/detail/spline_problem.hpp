#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "motion/sim2.hpp"
#include "registration/spline_basis.hpp"
#include "smoothing/drawing_spline.hpp"

namespace sketchloc::detail {

using Values = Eigen::Matrix<double, Eigen::Dynamic, 2>;  ///< px, a row per control point

/// What the registrations of a keyframe say together: a pose, and the information of its error
/// (x m, y m, heading rad, log scale) in the robot frame, of which a share is new.
struct Sight {
  std::size_t keyframe = 0;
  Sim2 sketch_from_robot;
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  double new_share = 1.0;
};

/// Those of all keyframes that have registrations near their smoothed pose.
std::vector<Sight> sights_of(const KeyframeRun& run, std::span<const SmoothedPose> smoothed,
                             const DrawingSplineParams& params);

/// An odometry edge between neighbours, with the information of (x m, y m, heading rad).
struct Step {
  Se2 before_from_now;
  Eigen::Vector3d information;
};

/// What the evidence weighs.
struct Weights {
  double bending = 0.0;        ///< of v^T B v, both components
  double noise_factor = 1.0;   ///< divides the information of sights
  std::vector<double> robust;  ///< of each sight, in (0, 1]
};

/// Trajectory and spline: the unknowns.
struct SplineState {
  std::vector<Eigen::Vector3d> poses;  ///< x m, y m, heading rad in the metric frame
  Values values;
};

/// Normal equations with the poses eliminated.
struct SplineStep {
  Eigen::VectorXd poses;   ///< changes, 3 per pose but the first
  Eigen::VectorXd values;  ///< all x, then all y
  Eigen::MatrixXd schur;   ///< information of the values; damped are the poses only
};

class SplineProblem {
 public:
  SplineProblem(SplineBasis basis, std::vector<Sight> sights, std::vector<Step> steps)
      : basis_(std::move(basis)), sights_(std::move(sights)), steps_(std::move(steps)) {}

  /// The error of a sight, in metres, rad and log scale; none where the spline folds there.
  std::optional<Eigen::Vector4d> error_of(const Sight& sight, const SplineState& state) const;

  /// chi2 of all; infinite where the spline folds at a keyframe.
  double cost(const SplineState& state, const Weights& weights) const;

  /// Gauss-Newton with damping; none where the equations cannot be solved.
  std::optional<SplineStep> step(const SplineState& state, const Weights& weights,
                                 double damping) const;

  const SplineBasis& basis() const { return basis_; }
  std::span<const Sight> sights() const { return sights_; }

 private:
  SplineBasis basis_;
  std::vector<Sight> sights_;
  std::vector<Step> steps_;
};

SplineState moved(const SplineState& state, const SplineStep& step);

}  // namespace sketchloc::detail
