#include "motion/graph/detail/agreement.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <utility>

#include "motion/angles.hpp"

namespace sketchloc::detail {
namespace {

/// Edges that are sure, from the end of an edge to the end of its neighbour.
constexpr int kReach = 10;

/// A motion and the covariance of what is wrong with it, (x, y, yaw) in the frame it ends in.
struct UncertainMotion {
  GraphPose motion;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// What a small motion in the frame that `motion` begins in is in the one that it ends in.
Eigen::Matrix3d carried_by(const GraphPose& motion) {
  const double cosine = std::cos(motion.yaw_rad);
  const double sine = std::sin(motion.yaw_rad);
  Eigen::Matrix3d carried = Eigen::Matrix3d::Identity();
  carried.topLeftCorner<2, 2>() << cosine, sine, -sine, cosine;
  carried.topRightCorner<2, 1>() =
      carried.topLeftCorner<2, 2>() * Eigen::Vector2d(-motion.y, motion.x);
  return carried;
}

UncertainMotion operator*(const UncertainMotion& a, const UncertainMotion& b) {
  const Eigen::Matrix3d carried = carried_by(b.motion);
  return {.motion = compose(a.motion, b.motion),
          .covariance = carried * a.covariance * carried.transpose() + b.covariance};
}

UncertainMotion inverse(const UncertainMotion& a) {
  const GraphPose back = between(a.motion, GraphPose{});
  const Eigen::Matrix3d carried = carried_by(back);
  return {.motion = back, .covariance = carried * a.covariance * carried.transpose()};
}

/// Along the edge from `from` to its other vertex.
UncertainMotion along(const GraphEdge& edge, std::size_t from) {
  const UncertainMotion forward{.motion = edge.measured,
                                .covariance = edge.information.topLeftCorner<3, 3>().inverse()};
  return edge.first == from ? forward : inverse(forward);
}

std::size_t other_end(const GraphEdge& edge, std::size_t vertex) {
  return edge.first == vertex ? edge.second : edge.first;
}

/// A vertex near another one, and the way there.
struct Neighbour {
  std::size_t vertex = 0;
  UncertainMotion way = {};
  int edges = 0;
};

class Surroundings {
 public:
  Surroundings(std::span<const GraphEdge> edges, std::size_t vertices)
      : edges_(edges), sure_(vertices), doubted_(vertices), place_(vertices, kNowhere) {
    for (std::size_t i = 0; i < edges.size(); ++i) {
      auto& lists = edges[i].may_be_wrong ? doubted_ : sure_;
      lists[edges[i].first].push_back(i);
      lists[edges[i].second].push_back(i);
    }
  }

  /// See agreeing_edges().
  int agreeing(std::size_t index, double bound) {
    const GraphEdge& edge = edges_[index];
    const std::vector<Neighbour> at_first = around(edge.first);
    const std::vector<Neighbour> at_second = around(edge.second);
    for (std::size_t i = 0; i < at_second.size(); ++i) {
      place_[at_second[i].vertex] = i;
    }
    int count = 0;
    for (const Neighbour& near : at_first) {
      for (const std::size_t other : doubted_[near.vertex]) {
        const std::size_t end = other_end(edges_[other], near.vertex);
        if (other != index && place_[end] != kNowhere) {
          const UncertainMotion detour =
              near.way * along(edges_[other], near.vertex) * inverse(at_second[place_[end]].way);
          count += closes(detour * inverse(along(edge, edge.first)), bound) ? 1 : 0;
        }
      }
    }
    for (const Neighbour& near : at_second) {
      place_[near.vertex] = kNowhere;
    }
    return count;
  }

 private:
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

  static bool closes(const UncertainMotion& loop, double bound) {
    const Eigen::Vector3d error(loop.motion.x, loop.motion.y, wrap_rad(loop.motion.yaw_rad));
    return error.dot(loop.covariance.ldlt().solve(error)) <= bound;
  }

  /// Breadth first; the vertex itself comes first.
  std::vector<Neighbour> around(std::size_t vertex) {
    std::vector<Neighbour> found{{.vertex = vertex}};
    place_[vertex] = 0;
    for (std::size_t i = 0; i < found.size() && found[i].edges < kReach; ++i) {
      for (const std::size_t index : sure_[found[i].vertex]) {
        const std::size_t next = other_end(edges_[index], found[i].vertex);
        if (place_[next] == kNowhere) {
          place_[next] = 0;
          found.push_back({.vertex = next,
                           .way = found[i].way * along(edges_[index], found[i].vertex),
                           .edges = found[i].edges + 1});
        }
      }
    }
    for (const Neighbour& near : found) {
      place_[near.vertex] = kNowhere;
    }
    return found;
  }

  std::span<const GraphEdge> edges_;
  std::vector<std::vector<std::size_t>> sure_;     ///< edges at each vertex
  std::vector<std::vector<std::size_t>> doubted_;  ///< edges at each vertex
  std::vector<std::size_t> place_;                 ///< scratch, of each vertex
};

}  // namespace

std::vector<int> agreeing_edges(std::span<const GraphEdge> edges, std::size_t vertices,
                                double width) {
  Surroundings surroundings(edges, vertices);
  std::vector<int> agreeing(edges.size(), 0);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    agreeing[i] = edges[i].may_be_wrong ? surroundings.agreeing(i, width * width) : 0;
  }
  return agreeing;
}

}  // namespace sketchloc::detail
