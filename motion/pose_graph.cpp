#include "motion/pose_graph.hpp"

#include <cmath>
#include <complex>
#include <stdexcept>
#include <string>

#include "motion/check.hpp"

namespace sketchloc {
namespace {

std::complex<double> scaled_rotation(const GraphPose& pose) {
  return std::polar(std::exp(pose.log_scale), pose.yaw_rad);
}

bool is_finite(const GraphPose& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.yaw_rad) &&
         std::isfinite(pose.log_scale);
}

[[noreturn]] void refuse(const char* what, std::size_t index, const char* why) {
  throw std::invalid_argument(std::string(what) + " " + std::to_string(index) + ": " + why);
}

GraphEdge edge(EdgeKind kind, std::size_t first, std::size_t second, const GraphPose& measured,
               const Eigen::Matrix4d& information) {
  return {.kind = kind,
          .first = first,
          .second = second,
          .measured = measured,
          .information = information,
          .may_be_wrong = false};
}

}  // namespace

GraphPose graph_pose(const Se2& pose) {
  return {.x = pose.x_m(), .y = pose.y_m(), .yaw_rad = pose.yaw_rad()};
}

GraphPose graph_pose(const Sim2& pose) {
  return {
      .x = pose.x(), .y = pose.y(), .yaw_rad = pose.yaw_rad(), .log_scale = std::log(pose.scale())};
}

Se2 to_se2(const GraphPose& pose) { return Se2::from_xy_yaw(pose.x, pose.y, pose.yaw_rad); }

Sim2 to_sim2(const GraphPose& pose) {
  return Sim2::from_xy_yaw_scale(pose.x, pose.y, pose.yaw_rad, std::exp(pose.log_scale));
}

GraphPose compose(const GraphPose& a_from_b, const GraphPose& b_from_c) {
  const std::complex<double> shift =
      scaled_rotation(a_from_b) * std::complex<double>(b_from_c.x, b_from_c.y);
  return {.x = a_from_b.x + shift.real(),
          .y = a_from_b.y + shift.imag(),
          .yaw_rad = a_from_b.yaw_rad + b_from_c.yaw_rad,
          .log_scale = a_from_b.log_scale + b_from_c.log_scale};
}

GraphPose between(const GraphPose& a_from_b, const GraphPose& a_from_c) {
  const std::complex<double> shift =
      std::complex<double>(a_from_c.x - a_from_b.x, a_from_c.y - a_from_b.y) /
      scaled_rotation(a_from_b);
  return {.x = shift.real(),
          .y = shift.imag(),
          .yaw_rad = a_from_c.yaw_rad - a_from_b.yaw_rad,
          .log_scale = a_from_c.log_scale - a_from_b.log_scale};
}

Eigen::Matrix4d information_of(const Eigen::Matrix3d& rigid) {
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  information.topLeftCorner<3, 3>() = rigid;
  return information;
}

GraphEdge between_edge(std::size_t first, std::size_t second, const Se2& first_from_second,
                       const Eigen::Matrix3d& information) {
  return edge(EdgeKind::Between, first, second, graph_pose(first_from_second),
              information_of(information));
}

GraphEdge between_edge(std::size_t first, std::size_t second, const Sim2& first_from_second,
                       const Eigen::Matrix4d& information) {
  return edge(EdgeKind::Between, first, second, graph_pose(first_from_second), information);
}

GraphEdge prior_edge(std::size_t vertex, const Se2& frame_from_body,
                     const Eigen::Matrix3d& information) {
  return edge(EdgeKind::Prior, vertex, vertex, graph_pose(frame_from_body),
              information_of(information));
}

GraphEdge prior_edge(std::size_t vertex, const Sim2& frame_from_body,
                     const Eigen::Matrix4d& information) {
  return edge(EdgeKind::Prior, vertex, vertex, graph_pose(frame_from_body), information);
}

GraphEdge registration_edge(std::size_t sketch_from_frame, std::size_t vertex,
                            const Sim2& sketch_from_body, const Eigen::Matrix4d& information) {
  return edge(EdgeKind::Registration, sketch_from_frame, vertex, graph_pose(sketch_from_body),
              information);
}

GraphEdge manhattan_edge(std::size_t first, std::size_t second, ManhattanAxis axis,
                         double offset_sigma_m, double heading_sigma_rad) {
  check(offset_sigma_m > 0.0 && heading_sigma_rad > 0.0, "standard deviations are positive");
  const int across = axis == ManhattanAxis::Forward ? 1 : 0;
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  information(across, across) = 1.0 / (offset_sigma_m * offset_sigma_m);
  information(2, 2) = 1.0 / (heading_sigma_rad * heading_sigma_rad);
  return edge(EdgeKind::Manhattan, first, second, {}, information);
}

void validate(const PoseGraph& graph) {
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
    if (!is_finite(graph.vertices[i].frame_from_body)) {
      refuse("vertex", i, "a number is not finite");
    }
  }
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const GraphEdge& edge = graph.edges[i];
    if (edge.first >= graph.vertices.size() || edge.second >= graph.vertices.size()) {
      refuse("edge", i, "it names a vertex that is not there");
    }
    if (!is_finite(edge.measured) || !edge.information.allFinite()) {
      refuse("edge", i, "a number is not finite");
    }
    if ((edge.kind == EdgeKind::Prior) != (edge.first == edge.second)) {
      refuse("edge", i, "priors have one vertex, other edges two different ones");
    }
    if (edge.information != edge.information.transpose() ||
        edge.information.diagonal().minCoeff() < 0.0) {
      refuse("edge", i, "the information is not that of a covariance");
    }
  }
}

}  // namespace sketchloc
