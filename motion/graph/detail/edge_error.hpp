#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "motion/pose_graph.hpp"

namespace sketchloc::detail {

/// A pose with the functions of its heading and scale, which several edges need.
struct TurnedPose {
  GraphPose pose;
  double cosine = 1.0;
  double sine = 0.0;
  double scale = 1.0;
};

inline TurnedPose turned(const GraphPose& pose) {
  return {.pose = pose,
          .cosine = std::cos(pose.yaw_rad),
          .sine = std::sin(pose.yaw_rad),
          .scale = pose.log_scale == 0.0 ? 1.0 : std::exp(pose.log_scale)};
}

/// To the nearest multiple of `period`: in [-period / 2, period / 2].
inline double wrapped(double angle_rad, double period) {
  return angle_rad - period * std::nearbyint(angle_rad / period);
}

/// The error of an edge with its derivatives by (x, y, yaw, log scale) of its vertices. The
/// position of the error is turned and scaled into the frame that the measurement is given in, so
/// information has to be that of turned_information().
struct LinearEdge {
  Eigen::Vector4d error = Eigen::Vector4d::Zero();
  Eigen::Matrix4d by_first = Eigen::Matrix4d::Zero();
  Eigen::Matrix4d by_second = Eigen::Matrix4d::Zero();  ///< zero for priors
};

/// Of Between and Manhattan: R(first)^T (second - first) / scale - measured.
inline Eigen::Vector4d relative_error(const GraphEdge& edge, const TurnedPose& first,
                                      const TurnedPose& second) {
  const double dx = second.pose.x - first.pose.x;
  const double dy = second.pose.y - first.pose.y;
  const double period = edge.kind == EdgeKind::Manhattan ? std::numbers::pi / 2.0  //
                                                         : 2.0 * std::numbers::pi;
  const double turn_rad = second.pose.yaw_rad - first.pose.yaw_rad - edge.measured.yaw_rad;
  return {(first.cosine * dx + first.sine * dy) / first.scale - edge.measured.x,
          (first.cosine * dy - first.sine * dx) / first.scale - edge.measured.y,
          wrapped(turn_rad, period),
          second.pose.log_scale - first.pose.log_scale - edge.measured.log_scale};
}

inline LinearEdge linear_relative(const GraphEdge& edge, const TurnedPose& first,
                                  const TurnedPose& second) {
  LinearEdge linear;
  linear.error = relative_error(edge, first, second);
  const double cosine = first.cosine / first.scale;
  const double sine = first.sine / first.scale;
  const double ahead = linear.error[0] + edge.measured.x;
  const double left = linear.error[1] + edge.measured.y;
  linear.by_second.diagonal() << cosine, cosine, 1.0, 1.0;
  linear.by_second(0, 1) = sine;
  linear.by_second(1, 0) = -sine;
  linear.by_first = -linear.by_second;
  linear.by_first(0, 2) = left;
  linear.by_first(1, 2) = -ahead;
  linear.by_first(0, 3) = -ahead;
  linear.by_first(1, 3) = -left;
  return linear;
}

inline Eigen::Vector4d difference(const GraphPose& pose, const GraphPose& measured) {
  return {pose.x - measured.x, pose.y - measured.y,
          wrapped(pose.yaw_rad - measured.yaw_rad, 2.0 * std::numbers::pi),
          pose.log_scale - measured.log_scale};
}

inline Eigen::Vector4d registration_error(const GraphEdge& edge, const TurnedPose& first,
                                          const TurnedPose& second) {
  const GraphPose& inner = second.pose;
  const double cosine = first.cosine * first.scale;
  const double sine = first.sine * first.scale;
  return difference({.x = first.pose.x + cosine * inner.x - sine * inner.y,
                     .y = first.pose.y + sine * inner.x + cosine * inner.y,
                     .yaw_rad = first.pose.yaw_rad + inner.yaw_rad,
                     .log_scale = first.pose.log_scale + inner.log_scale},
                    edge.measured);
}

/// first * second - measured: the vertex `first` says how the frame of `second` lies in that of the
/// measurement.
inline LinearEdge linear_registration(const GraphEdge& edge, const TurnedPose& first,
                                      const TurnedPose& second) {
  LinearEdge linear;
  linear.error = registration_error(edge, first, second);
  const double cosine = first.cosine * first.scale;
  const double sine = first.sine * first.scale;
  const double x = cosine * second.pose.x - sine * second.pose.y;
  const double y = sine * second.pose.x + cosine * second.pose.y;
  linear.by_first.setIdentity();
  linear.by_first(0, 2) = -y;
  linear.by_first(1, 2) = x;
  linear.by_first(0, 3) = x;
  linear.by_first(1, 3) = y;
  linear.by_second.diagonal() << cosine, cosine, 1.0, 1.0;
  linear.by_second(0, 1) = -sine;
  linear.by_second(1, 0) = sine;
  return linear;
}

inline Eigen::Vector4d error_of(const GraphEdge& edge, const TurnedPose& first,
                                const TurnedPose& second) {
  switch (edge.kind) {
    case EdgeKind::Prior:
      return difference(first.pose, edge.measured);
    case EdgeKind::Registration:
      return registration_error(edge, first, second);
    default:
      return relative_error(edge, first, second);
  }
}

inline LinearEdge linearised(const GraphEdge& edge, const TurnedPose& first,
                             const TurnedPose& second) {
  switch (edge.kind) {
    case EdgeKind::Prior:
      return {.error = difference(first.pose, edge.measured),
              .by_first = Eigen::Matrix4d::Identity()};
    case EdgeKind::Registration:
      return linear_registration(edge, first, second);
    default:
      return linear_relative(edge, first, second);
  }
}

/// The information for errors whose position is not turned into the measured pose's own frame: M^T
/// information M, where M = R(measured)^T / scale does that.
inline Eigen::Matrix4d turned_information(const GraphEdge& edge) {
  const TurnedPose measured = turned(edge.measured);
  Eigen::Matrix4d into_measured = Eigen::Matrix4d::Identity();
  into_measured.topLeftCorner<2, 2>() << measured.cosine, measured.sine, -measured.sine,
      measured.cosine;
  into_measured.topLeftCorner<2, 2>() /= measured.scale;
  return into_measured.transpose() * edge.information * into_measured;
}

}  // namespace sketchloc::detail
