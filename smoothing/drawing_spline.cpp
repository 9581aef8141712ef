#include "smoothing/drawing_spline.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/check.hpp"
#include "motion/validate.hpp"
#include "registration/polar.hpp"
#include "smoothing/detail/spline_problem.hpp"

namespace sketchloc {
namespace {

using detail::Sight;
using detail::SplineProblem;
using detail::SplineState;
using detail::Step;
using detail::Values;
using detail::Weights;

constexpr double kReach_m = 2.0;   ///< points this far around a pose begin the spline
constexpr int kStepsPerRound = 3;  ///< of least squares between two weighings
constexpr double kStiffest =
    1e6;  ///< of the bending's weight in (m / px)^2, which falls from there
constexpr double kSettled = 0.02;  ///< relative change of the weights at which they are found
constexpr double kMostDamping = 1e6;

/// The odometry's poses, the first keyframe's at its own.
std::vector<Eigen::Vector3d> driven_poses(const KeyframeRun& run) {
  std::vector<Eigen::Vector3d> poses;
  for (const Keyframe& keyframe : run.keyframes) {
    const Se2& pose = keyframe.odom_from_robot;
    poses.emplace_back(pose.translation().x(), pose.translation().y(), pose.yaw_rad());
  }
  return poses;
}

std::vector<Step> odometry_steps(const KeyframeRun& run, const DrawingSplineParams& params) {
  constexpr double kLeastWay_m = 0.05;
  std::vector<Step> steps;
  for (std::size_t k = 1; k < run.keyframes.size(); ++k) {
    const Keyframe& now = run.keyframes[k];
    const double way_m = std::max(now.way_m, kLeastWay_m);
    const double slip = params.slip_m * params.slip_m * way_m;
    const double turned = params.turn_rad_per_rad * now.turn_rad;
    const double turn = params.turn_rad * params.turn_rad * way_m + turned * turned;
    steps.push_back(
        {.before_from_now = run.keyframes[k - 1].odom_from_robot.inverse() * now.odom_from_robot,
         .information = {1.0 / slip, 1.0 / slip, 1.0 / turn}});
  }
  return steps;
}

/// A lattice over the way and a margin, as fine as allowed; none where the way is no more than a
/// place.
std::vector<Eigen::Vector2d> control_lattice(const std::vector<Eigen::Vector3d>& poses,
                                             const DrawingSplineParams& params) {
  Eigen::Vector2d low = poses.front().head<2>();
  Eigen::Vector2d high = low;
  for (const Eigen::Vector3d& pose : poses) {
    low = low.cwiseMin(pose.head<2>());
    high = high.cwiseMax(pose.head<2>());
  }
  if ((high - low).maxCoeff() < params.spacing_m) {
    return {};
  }
  low.array() -= params.margin_m;
  high.array() += params.margin_m;
  const Eigen::Vector2d size = high - low;
  Eigen::Array2i cells;
  double spacing = params.spacing_m;
  do {
    cells = (size / spacing).array().ceil().cast<int>().max(2);
    spacing *= 1.05;
  } while ((cells + 1).prod() > params.max_controls && spacing < size.maxCoeff());
  std::vector<Eigen::Vector2d> controls;
  for (int row = 0; row <= cells.y(); ++row) {
    for (int column = 0; column <= cells.x(); ++column) {
      controls.emplace_back(low.x() + size.x() * column / cells.x(),
                            low.y() + size.y() * row / cells.y());
    }
  }
  return controls;
}

/// The affine map that takes the surroundings of the driven poses to those of the smoothed ones,
/// as values of the control points.
Values affine_values(const std::vector<Eigen::Vector2d>& controls,
                     const std::vector<Eigen::Vector3d>& poses,
                     std::span<const SmoothedPose> smoothed) {
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();
  Eigen::Matrix<double, 3, 2> right = Eigen::Matrix<double, 3, 2>::Zero();
  for (std::size_t k = 0; k < poses.size(); ++k) {
    for (const Eigen::Vector2d& beside :
         {Eigen::Vector2d(kReach_m, 0.0), Eigen::Vector2d(0.0, kReach_m),
          Eigen::Vector2d(-kReach_m, 0.0), Eigen::Vector2d(0.0, -kReach_m)}) {
      const Eigen::Vector2d point = poses[k].head<2>() + Eigen::Rotation2Dd(poses[k].z()) * beside;
      const Eigen::Vector3d row(1.0, point.x(), point.y());
      square += row * row.transpose();
      right += row * (smoothed[k].sketch_from_robot * beside).transpose();
    }
  }
  const Eigen::Matrix<double, 3, 2> affine = square.ldlt().solve(right);
  Values values(static_cast<Eigen::Index>(controls.size()), 2);
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    const Eigen::Vector2d& control = controls[static_cast<std::size_t>(i)];
    values.row(i) = Eigen::RowVector3d(1.0, control.x(), control.y()) * affine;
  }
  return values;
}

/// Levenberg-Marquardt at fixed weights; the last equations, none where they cannot be solved.
std::optional<detail::SplineStep> improve(const SplineProblem& problem, SplineState& state,
                                          const Weights& weights) {
  double damping = 1e-6;
  double cost = problem.cost(state, weights);
  std::optional<detail::SplineStep> step;
  for (int i = 0; i < kStepsPerRound && damping < kMostDamping;) {
    step = problem.step(state, weights, damping);
    if (!step) {
      return std::nullopt;
    }
    SplineState tried = moved(state, *step);
    const double now = problem.cost(tried, weights);
    if (!(now <= cost)) {
      damping = std::max(1e-3, 10.0 * damping);
      continue;
    }
    const bool settled = cost - now < 1e-6 * cost;
    state = std::move(tried);
    cost = now;
    damping = 0.1 * damping;
    ++i;
    if (settled) {
      break;
    }
  }
  return step;
}

double bending_of(const SplineProblem& problem, const Values& values) {
  return (values.transpose() * problem.basis().bending() * values).trace();
}

/// How many of the bends are told by the data and not by the prior [MacKay92].
double effective_parameters(const SplineProblem& problem, const Eigen::MatrixXd& schur,
                            double bending) {
  const Eigen::MatrixXd& one = problem.basis().bending();
  const Eigen::Index size = one.rows();
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(2 * size, 2 * size);
  both.topLeftCorner(size, size) = one;
  both.bottomRightCorner(size, size) = one;
  const double by_prior = bending * schur.ldlt().solve(both).trace();
  const auto bends = static_cast<double>(2 * (size - 3));
  return std::clamp(bends - by_prior, 1e-3, bends);
}

double squared_error(const SplineProblem& problem, const SplineState& state, const Sight& sight) {
  const std::optional<Eigen::Vector4d> error = problem.error_of(sight, state);
  check(error.has_value(), "least squares keep the spline from folding at keyframes");
  return error->dot(sight.information * *error);
}

/// Weights of a Student t; then the evidence's fixed point for noise and bending.
Weights reweighed(const SplineProblem& problem, const SplineState& state, const Weights& before,
                  double effective, double freedom) {
  Weights weights = before;
  double chi2 = 0.0;
  double told = 0.0;
  for (std::size_t i = 0; i < problem.sights().size(); ++i) {
    const Sight& sight = problem.sights()[i];
    const double squared = squared_error(problem, state, sight) / before.noise_factor;
    weights.robust[i] = (freedom + 4.0) / (freedom + squared);
    chi2 += weights.robust[i] * sight.new_share * squared;
    told += 4.0 * sight.new_share;
  }
  weights.noise_factor =
      std::max(1.0, before.noise_factor * chi2 / std::max(1.0, told - effective));
  weights.bending = std::min(before.bending * 100.0,
                             effective / std::max(bending_of(problem, state.values), 1e-12));
  return weights;
}

bool settled(double before, double now) { return std::abs(now - before) <= kSettled * before; }

double residual_m(const SplineProblem& problem, const SplineState& state) {
  double sum = 0.0;
  for (const Sight& sight : problem.sights()) {
    const std::optional<Eigen::Vector4d> error = problem.error_of(sight, state);
    sum += error ? error->head<2>().squaredNorm() : 0.0;
  }
  return std::sqrt(sum / static_cast<double>(problem.sights().size()));
}

std::vector<Se2> rigid(const std::vector<Eigen::Vector3d>& poses) {
  std::vector<Se2> result;
  for (const Eigen::Vector3d& pose : poses) {
    result.push_back(Se2::from_xy_yaw(pose.x(), pose.y(), pose.z()));
  }
  return result;
}

ThinPlateSpline spline_through(const SplineBasis& basis, const Values& values) {
  std::vector<Eigen::Vector2d> places;
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    places.emplace_back(values.row(i).transpose());
  }
  return TpsSolver::factor(basis.control_points())->solve(places);  // as for the basis
}

std::optional<DrawingSpline> fitted(const SplineProblem& problem, SplineState state,
                                    double px_per_m, const DrawingSplineParams& params) {
  Weights weights{.bending = kStiffest / (px_per_m * px_per_m),
                  .robust = std::vector<double>(problem.sights().size(), 1.0)};
  if (!std::isfinite(problem.cost(state, weights))) {
    return std::nullopt;
  }
  Eigen::MatrixXd schur;
  double effective = 0.0;
  double noise_factor = 1.0;
  bool converged = false;
  for (int round = 0; round < params.max_rounds && !converged; ++round) {
    auto last = improve(problem, state, weights);
    if (!last) {
      return std::nullopt;
    }
    schur = std::move(last->schur);
    effective = effective_parameters(problem, schur, weights.bending);
    const Weights next = reweighed(problem, state, weights, effective, params.freedom);
    converged =
        settled(weights.bending, next.bending) && settled(weights.noise_factor, next.noise_factor);
    noise_factor = std::exchange(weights, next).noise_factor;
  }
  return DrawingSpline{
      .sketch_from_metric = spline_through(problem.basis(), state.values),
      .basis = problem.basis(),
      .covariance = schur.ldlt().solve(Eigen::MatrixXd::Identity(schur.rows(), schur.rows())),
      .metric_from_robot = rigid(state.poses),
      .residual_m = residual_m(problem, state),
      .effective_parameters = effective,
      .noise_factor = noise_factor,
      .converged = converged};
}

}  // namespace

void validate(const DrawingSplineParams& params) {
  require_above("spacing_m", params.spacing_m, 0.0);
  require_in_range("max_controls", params.max_controls, 9, 1000);
  require_at_least("margin_m", params.margin_m, 0.0);
  require_above("slip_m", params.slip_m, 0.0);
  require_above("turn_rad", params.turn_rad, 0.0);
  require_at_least("turn_rad_per_rad", params.turn_rad_per_rad, 0.0);
  require_above("independent_way_m", params.independent_way_m, 0.0);
  require_above("freedom", params.freedom, 0.0);
  validate_part("kernel", params.kernel);
  require_in_range("max_rounds", params.max_rounds, 1, 1000);
}

std::optional<Sim2> DrawingSpline::sketch_from_robot(std::size_t keyframe) const {
  const Se2& pose = metric_from_robot.at(keyframe);
  const PlaneMapPoint map = sketch_from_metric.at(pose.translation());
  const double determinant = map.jacobian.determinant();
  if (!(determinant > 0.0)) {
    return std::nullopt;
  }
  const double yaw = polar_yaw_rad(map.jacobian) + pose.yaw_rad();
  return Sim2::from_xy_yaw_scale(map.value.x(), map.value.y(), yaw, std::sqrt(determinant));
}

double DrawingSpline::sigma_m(const Eigen::Vector2d& point) const {
  const SplineBasis::At at = basis.at(point);
  const Eigen::Index size = at.value.size();
  Eigen::Matrix2d spread;
  for (Eigen::Index row = 0; row < 2; ++row) {
    for (Eigen::Index column = 0; column < 2; ++column) {
      spread(row, column) =
          at.value.dot(covariance.block(row * size, column * size, size, size) * at.value);
    }
  }
  const Eigen::Matrix2d back = sketch_from_metric.jacobian(point).inverse();
  const Eigen::Matrix2d in_m = back * spread * back.transpose();
  const double middle = 0.5 * in_m.trace();
  const double apart = std::sqrt(std::max(0.0, middle * middle - in_m.determinant()));
  return std::sqrt(std::max(0.0, middle + apart));
}

std::optional<DrawingSpline> fit_drawing_spline(const KeyframeRun& run,
                                                std::span<const SmoothedPose> smoothed,
                                                const DrawingSplineParams& params) {
  validate(params);
  check(smoothed.size() == run.keyframes.size(), "a pose per keyframe");
  std::vector<Sight> sights = detail::sights_of(run, smoothed, params);
  if (run.keyframes.size() < 2 || sights.empty()) {
    return std::nullopt;
  }
  SplineState state{.poses = driven_poses(run), .values = {}};
  const std::vector<Eigen::Vector2d> controls = control_lattice(state.poses, params);
  std::optional<SplineBasis> basis = SplineBasis::over(controls);
  if (!basis) {
    return std::nullopt;
  }
  state.values = affine_values(controls, state.poses, smoothed);
  const double px_per_m = smoothed.front().sketch_from_robot.scale();
  return fitted(SplineProblem(*std::move(basis), std::move(sights), odometry_steps(run, params)),
                std::move(state), px_per_m, params);
}

}  // namespace sketchloc
