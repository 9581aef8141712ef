#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "motion/se2.hpp"
#include "motion/sim2.hpp"

namespace sketchloc {

/// A pose as graphs keep it: plain numbers that every bit of a file survives in. The heading need
/// not be wrapped. The unit of x and y is that of the frame the pose is in: m, or px of a drawing.
struct GraphPose {
  double x = 0.0;
  double y = 0.0;
  double yaw_rad = 0.0;
  double log_scale = 0.0;  ///< 0 for rigid motions

  bool operator==(const GraphPose&) const = default;
};

GraphPose graph_pose(const Se2& pose);
GraphPose graph_pose(const Sim2& pose);
Se2 to_se2(const GraphPose& pose);  ///< drops the scale
Sim2 to_sim2(const GraphPose& pose);

/// a_from_b * b_from_c.
GraphPose compose(const GraphPose& a_from_b, const GraphPose& b_from_c);
/// The inverse of a_from_b, times a_from_c: b_from_c.
GraphPose between(const GraphPose& a_from_b, const GraphPose& a_from_c);

/// Which group a vertex moves in: 3 or 4 numbers are estimated.
enum class VertexKind { Se2, Sim2 };

struct GraphVertex {
  std::int64_t id = 0;  ///< its name in files; unique in a graph
  VertexKind kind = VertexKind::Se2;
  GraphPose frame_from_body = {};  ///< all vertices of a connected graph share a frame
  bool is_fixed = false;           ///< it stays where it is

  bool operator==(const GraphVertex&) const = default;
};

enum class EdgeKind {
  Between,       ///< first_from_second was measured
  Prior,         ///< frame_from_first was measured; `second` is `first`
  Registration,  ///< other_from_second was measured, and other_from_frame is the vertex `first`
  Manhattan,     ///< like Between, but the heading is known up to quarter turns only
};

/// One measurement with its information, the inverse of a covariance. Its error is the pose
/// inverse(measured) * estimated as (x, y, heading, log scale), the heading wrapped (of a Manhattan
/// edge: to the nearest quarter turn). What its zeros leave open is not measured.
struct GraphEdge {
  EdgeKind kind = EdgeKind::Between;
  std::size_t first = 0;   ///< index of a vertex, not its id
  std::size_t second = 0;  ///< index of a vertex
  GraphPose measured = {};
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();  ///< symmetric, no negative eigenvalue
  bool may_be_wrong = false;                              ///< robust kernels apply to it

  bool operator==(const GraphEdge&) const = default;
};

/// Poses and what was measured between them.
struct PoseGraph {
  std::vector<GraphVertex> vertices = {};
  std::vector<GraphEdge> edges = {};

  bool operator==(const PoseGraph&) const = default;
};

/// The information of a rigid measurement: nothing about scale.
Eigen::Matrix4d information_of(const Eigen::Matrix3d& rigid);

GraphEdge between_edge(std::size_t first, std::size_t second, const Se2& first_from_second,
                       const Eigen::Matrix3d& information);
GraphEdge between_edge(std::size_t first, std::size_t second, const Sim2& first_from_second,
                       const Eigen::Matrix4d& information);
GraphEdge prior_edge(std::size_t vertex, const Se2& frame_from_body,
                     const Eigen::Matrix3d& information);
GraphEdge prior_edge(std::size_t vertex, const Sim2& frame_from_body,
                     const Eigen::Matrix4d& information);
/// A registration in another frame than the vertices', such as a drawing: the vertex
/// `sketch_from_frame` says how that frame lies in it.
GraphEdge registration_edge(std::size_t sketch_from_frame, std::size_t vertex,
                            const Sim2& sketch_from_body, const Eigen::Matrix4d& information);

/// Along which axis of its first vertex a Manhattan edge runs.
enum class ManhattanAxis { Forward, Sideways };
/// Two vertices in one aisle, at any distance: heading apart by a multiple of 90 deg, no offset
/// across the axis.
GraphEdge manhattan_edge(std::size_t first, std::size_t second, ManhattanAxis axis,
                         double offset_sigma_m, double heading_sigma_rad);

/// Throws std::invalid_argument where an edge names a vertex that is not there or has a value that
/// is not finite, or an information that is not symmetric or has a negative diagonal.
void validate(const PoseGraph& graph);

}  // namespace sketchloc
