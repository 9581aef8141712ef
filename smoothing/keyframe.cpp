#include "smoothing/keyframe.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace sketchloc {
namespace {

/// Jacobian of a pose's parts in the sketch by those of a small step in the robot frame.
Eigen::Matrix4d sketch_by_robot(const Sim2& sketch_from_robot) {
  Eigen::Matrix4d jacobian = Eigen::Matrix4d::Identity();
  jacobian.topLeftCorner<2, 2>() =
      sketch_from_robot.scale() *
      Eigen::Rotation2Dd(sketch_from_robot.yaw_rad()).toRotationMatrix();
  return jacobian;
}

}  // namespace

PoseHypothesis hypothesis_of(const Sim2& sketch_from_robot,
                             const Eigen::Matrix4d& covariance_in_sketch,
                             double inlier_probability) {
  const Eigen::Matrix4d robot_by_sketch = sketch_by_robot(sketch_from_robot).inverse();
  return {.sketch_from_robot = sketch_from_robot,
          .covariance = robot_by_sketch * covariance_in_sketch * robot_by_sketch.transpose(),
          .inlier_probability = inlier_probability};
}

Eigen::Matrix4d covariance_in_sketch(const PoseHypothesis& hypothesis) {
  const Eigen::Matrix4d jacobian = sketch_by_robot(hypothesis.sketch_from_robot);
  return jacobian * hypothesis.covariance * jacobian.transpose();
}

}  // namespace sketchloc
