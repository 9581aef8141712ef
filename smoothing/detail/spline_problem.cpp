#include "smoothing/detail/spline_problem.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "motion/angles.hpp"
#include "motion/graph/kernel.hpp"
#include "registration/polar.hpp"

namespace sketchloc::detail {
namespace {

constexpr double kLeastShare = 1e-3;  ///< of a sight that is new

Eigen::Vector4d error_between(const Sim2& from, const Sim2& to) {
  const Sim2 off = from.inverse() * to;
  return {off.x(), off.y(), off.yaw_rad(), std::log(off.scale())};
}

/// The spline at a pose, and how it changes.
struct LocalMap {
  SplineBasis::At at;
  Eigen::Vector2d place;
  Eigen::Matrix2d jacobian;
  Eigen::Matrix2d by_x;  ///< the Jacobian's derivatives
  Eigen::Matrix2d by_y;
};

LocalMap local_map(const SplineBasis& basis, const Values& values, const Eigen::Vector2d& point) {
  LocalMap map{.at = basis.at(point), .place = {}, .jacobian = {}, .by_x = {}, .by_y = {}};
  map.place = values.transpose() * map.at.value;
  map.jacobian << values.transpose() * map.at.x, values.transpose() * map.at.y;
  map.by_x << values.transpose() * map.at.xx, values.transpose() * map.at.xy;
  map.by_y << values.transpose() * map.at.xy, values.transpose() * map.at.yy;
  return map;
}

/// Derivatives of polar_yaw_rad() by the entries of the Jacobian.
Eigen::Matrix2d yaw_gradient(const Eigen::Matrix2d& j) {
  const double s = j(1, 0) - j(0, 1);
  const double c = j(0, 0) + j(1, 1);
  Eigen::Matrix2d gradient;
  gradient << -s, -c, c, -s;
  return gradient / (s * s + c * c);
}

Eigen::Vector4d error_at(const Sight& sight, const LocalMap& map, double heading_rad) {
  const Eigen::Matrix2d robot_from_sketch =
      sight.sketch_from_robot.inverse().scaled_rotation_matrix();
  Eigen::Vector4d error;
  error << robot_from_sketch * (map.place - sight.sketch_from_robot.translation()),
      wrap_rad(polar_yaw_rad(map.jacobian) + heading_rad - sight.sketch_from_robot.yaw_rad()),
      0.5 * std::log(map.jacobian.determinant()) - std::log(sight.sketch_from_robot.scale());
  return error;
}

double inner(const Eigen::Matrix2d& a, const Eigen::Matrix2d& b) { return a.cwiseProduct(b).sum(); }

/// How the error changes with (x, y, heading) of the pose.
Eigen::Matrix<double, 4, 3> by_pose(const Sight& sight, const LocalMap& map) {
  const Eigen::Matrix2d yaw = yaw_gradient(map.jacobian);
  const Eigen::Matrix2d log_scale = 0.5 * map.jacobian.inverse().transpose();
  Eigen::Matrix<double, 4, 3> result = Eigen::Matrix<double, 4, 3>::Zero();
  result.topLeftCorner<2, 2>() =
      sight.sketch_from_robot.inverse().scaled_rotation_matrix() * map.jacobian;
  result.row(2) << inner(yaw, map.by_x), inner(yaw, map.by_y), 1.0;
  result.row(3) << inner(log_scale, map.by_x), inner(log_scale, map.by_y), 0.0;
  return result;
}

/// How it changes with the values: all x, then all y.
Eigen::Matrix<double, 4, Eigen::Dynamic> by_values(const Sight& sight, const LocalMap& map) {
  const Eigen::Index size = map.at.value.size();
  const Eigen::Matrix2d turn = sight.sketch_from_robot.inverse().scaled_rotation_matrix();
  const Eigen::Matrix2d yaw = yaw_gradient(map.jacobian);
  const Eigen::Matrix2d log_scale = 0.5 * map.jacobian.inverse().transpose();
  Eigen::Matrix<double, 4, Eigen::Dynamic> result(4, 2 * size);
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    auto part = result.middleCols(axis * size, size);
    part.row(0) = turn(0, axis) * map.at.value.transpose();
    part.row(1) = turn(1, axis) * map.at.value.transpose();
    part.row(2) = (yaw(axis, 0) * map.at.x + yaw(axis, 1) * map.at.y).transpose();
    part.row(3) = (log_scale(axis, 0) * map.at.x + log_scale(axis, 1) * map.at.y).transpose();
  }
  return result;
}

Eigen::Vector3d odometry_error(const Step& step, const Eigen::Vector3d& before,
                               const Eigen::Vector3d& now) {
  const Eigen::Vector2d driven =
      Eigen::Rotation2Dd(-before.z()) * (now.head<2>() - before.head<2>());
  return {driven.x() - step.before_from_now.translation().x(),
          driven.y() - step.before_from_now.translation().y(),
          wrap_rad(now.z() - before.z() - step.before_from_now.yaw_rad())};
}

/// How it changes with both poses.
Eigen::Matrix<double, 3, 6> odometry_jacobian(const Eigen::Vector3d& before,
                                              const Eigen::Vector3d& now) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(-before.z()).toRotationMatrix();
  const Eigen::Vector2d driven = turn * (now.head<2>() - before.head<2>());
  Eigen::Matrix<double, 3, 6> result = Eigen::Matrix<double, 3, 6>::Zero();
  result.topLeftCorner<2, 2>() = -turn;
  result.block<2, 1>(0, 2) << driven.y(), -driven.x();
  result(2, 2) = -1.0;
  result.block<2, 2>(0, 3) = turn;
  result(2, 5) = 1.0;
  return result;
}

/// The normal equations H x = -g; the first pose is held.
struct Normal {
  std::vector<Eigen::Triplet<double>> poses;  ///< lower triangle and diagonal
  Eigen::MatrixXd mixed;                      ///< poses by values
  Eigen::MatrixXd values;
  Eigen::VectorXd pose_gradient;
  Eigen::VectorXd value_gradient;

  Normal(Eigen::Index pose_count, Eigen::Index value_count)
      : mixed(Eigen::MatrixXd::Zero(pose_count, value_count)),
        values(Eigen::MatrixXd::Zero(value_count, value_count)),
        pose_gradient(Eigen::VectorXd::Zero(pose_count)),
        value_gradient(Eigen::VectorXd::Zero(value_count)) {}

  /// Adds a 3 x 3 block for two poses, the later one first; pose 0 has none.
  void add_block(std::size_t row, std::size_t column, const Eigen::Matrix3d& block) {
    if (row == 0 || column == 0) {
      return;
    }
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        poses.emplace_back(static_cast<int>(3 * (row - 1)) + i,
                           static_cast<int>(3 * (column - 1)) + j, block(i, j));
      }
    }
  }
  void add_gradient(std::size_t pose, const Eigen::Vector3d& gradient) {
    if (pose > 0) {
      pose_gradient.segment<3>(static_cast<Eigen::Index>(3 * (pose - 1))) += gradient;
    }
  }
};

void add_odometry(Normal& normal, const std::vector<Step>& steps, const SplineState& state) {
  for (std::size_t k = 1; k < state.poses.size(); ++k) {
    const Step& step = steps[k - 1];
    const Eigen::Matrix<double, 3, 6> jacobian =
        odometry_jacobian(state.poses[k - 1], state.poses[k]);
    const Eigen::Matrix<double, 6, 3> weighted =
        jacobian.transpose() * step.information.asDiagonal();
    const Eigen::Matrix<double, 6, 6> hessian = weighted * jacobian;
    const Eigen::Matrix<double, 6, 1> gradient =
        weighted * odometry_error(step, state.poses[k - 1], state.poses[k]);
    normal.add_block(k - 1, k - 1, hessian.topLeftCorner<3, 3>());
    normal.add_block(k, k - 1, hessian.bottomLeftCorner<3, 3>());
    normal.add_block(k, k, hessian.bottomRightCorner<3, 3>());
    normal.add_gradient(k - 1, gradient.head<3>());
    normal.add_gradient(k, gradient.tail<3>());
  }
}

void add_sight(Normal& normal, const Sight& sight, const LocalMap& map, const Eigen::Vector3d& pose,
               double weight) {
  const Eigen::Vector4d error = error_at(sight, map, pose.z());
  const Eigen::Matrix<double, 4, 3> by_x = by_pose(sight, map);
  const Eigen::Matrix<double, 4, Eigen::Dynamic> by_v = by_values(sight, map);
  const Eigen::Matrix4d information = weight * sight.information;
  const Eigen::Matrix<double, 3, 4> weighted = by_x.transpose() * information;
  normal.add_block(sight.keyframe, sight.keyframe, weighted * by_x);
  normal.add_gradient(sight.keyframe, weighted * error);
  if (sight.keyframe > 0) {
    normal.mixed.middleRows<3>(static_cast<Eigen::Index>(3 * (sight.keyframe - 1))) +=
        weighted * by_v;
  }
  normal.values.noalias() += by_v.transpose() * (information * by_v);
  normal.value_gradient.noalias() += by_v.transpose() * (information * error);
}

}  // namespace

std::vector<Sight> sights_of(const KeyframeRun& run, std::span<const SmoothedPose> smoothed,
                             const DrawingSplineParams& params) {
  std::vector<Sight> sights;
  double way_m = params.independent_way_m;
  for (std::size_t k = 0; k < run.keyframes.size(); ++k) {
    way_m += run.keyframes[k].way_m;
    const Sim2& centre = smoothed[k].sketch_from_robot;
    Sight sight{.keyframe = k, .sketch_from_robot = centre};
    Eigen::Vector4d pull = Eigen::Vector4d::Zero();
    double count = 0.0;
    for (const PoseHypothesis& one : run.keyframes[k].hypotheses) {
      const Eigen::Matrix4d information = one.covariance.inverse();
      const Eigen::Vector4d error = error_between(centre, one.sketch_from_robot);
      const double weight =
          one.inlier_probability * robust_weight(params.kernel, error.dot(information * error));
      sight.information += weight * information;
      pull += weight * information * error;
      count += weight;
    }
    if (count < kLeastShare) {
      continue;
    }
    const Eigen::Vector4d off = sight.information.ldlt().solve(pull);
    sight.sketch_from_robot =
        centre * Sim2::from_xy_yaw_scale(off.x(), off.y(), off.z(), std::exp(off.w()));
    sight.information /= std::max(1.0, count);  // they look at the same scans
    sight.new_share = std::clamp(way_m / params.independent_way_m, kLeastShare, 1.0);
    way_m = 0.0;
    sights.push_back(sight);
  }
  return sights;
}

std::optional<Eigen::Vector4d> SplineProblem::error_of(const Sight& sight,
                                                       const SplineState& state) const {
  const Eigen::Vector3d& pose = state.poses[sight.keyframe];
  const LocalMap map = local_map(basis_, state.values, pose.head<2>());
  if (!(map.jacobian.determinant() > 0.0)) {
    return std::nullopt;
  }
  return error_at(sight, map, pose.z());
}

double SplineProblem::cost(const SplineState& state, const Weights& weights) const {
  double sum =
      weights.bending * (state.values.transpose() * basis_.bending() * state.values).trace();
  for (std::size_t i = 0; i < sights_.size(); ++i) {
    const std::optional<Eigen::Vector4d> error = error_of(sights_[i], state);
    if (!error) {
      return std::numeric_limits<double>::infinity();
    }
    sum += weights.robust[i] * sights_[i].new_share / weights.noise_factor *
           error->dot(sights_[i].information * *error);
  }
  for (std::size_t k = 1; k < state.poses.size(); ++k) {
    const Eigen::Vector3d error = odometry_error(steps_[k - 1], state.poses[k - 1], state.poses[k]);
    sum += error.dot(steps_[k - 1].information.asDiagonal() * error);
  }
  return sum;
}

std::optional<SplineStep> SplineProblem::step(const SplineState& state, const Weights& weights,
                                              double damping) const {
  const auto pose_count = static_cast<Eigen::Index>(3 * (state.poses.size() - 1));
  const Eigen::Index size = state.values.rows();
  Normal normal(pose_count, 2 * size);
  add_odometry(normal, steps_, state);
  for (std::size_t i = 0; i < sights_.size(); ++i) {
    const Eigen::Vector3d& pose = state.poses[sights_[i].keyframe];
    add_sight(normal, sights_[i], local_map(basis_, state.values, pose.head<2>()), pose,
              weights.robust[i] * sights_[i].new_share / weights.noise_factor);
  }
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    normal.values.block(axis * size, axis * size, size, size) += weights.bending * basis_.bending();
    normal.value_gradient.segment(axis * size, size) +=
        weights.bending * basis_.bending() * state.values.col(axis);
  }
  for (Eigen::Index i = 0; i < pose_count; ++i) {
    normal.poses.emplace_back(static_cast<int>(i), static_cast<int>(i), damping);
  }
  Eigen::SparseMatrix<double> poses(pose_count, pose_count);
  poses.setFromTriplets(normal.poses.begin(), normal.poses.end());
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower> chain(poses);
  if (chain.info() != Eigen::Success) {
    return std::nullopt;
  }
  SplineStep result;
  result.schur = normal.values - normal.mixed.transpose() * chain.solve(normal.mixed);
  Eigen::MatrixXd damped = result.schur;
  damped.diagonal() *= 1.0 + damping;
  const Eigen::LLT<Eigen::MatrixXd> values(damped);
  if (values.info() != Eigen::Success) {
    return std::nullopt;
  }
  result.values = -values.solve(normal.value_gradient -
                                normal.mixed.transpose() * chain.solve(normal.pose_gradient));
  result.poses = -chain.solve(normal.pose_gradient + normal.mixed * result.values);
  return result;
}

SplineState moved(const SplineState& state, const SplineStep& step) {
  SplineState result = state;
  for (std::size_t k = 1; k < result.poses.size(); ++k) {
    result.poses[k] += step.poses.segment<3>(static_cast<Eigen::Index>(3 * (k - 1)));
  }
  const Eigen::Index size = result.values.rows();
  result.values.col(0) += step.values.head(size);
  result.values.col(1) += step.values.tail(size);
  return result;
}

}  // namespace sketchloc::detail
