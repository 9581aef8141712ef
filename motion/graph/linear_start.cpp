#include "motion/graph/linear_start.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

#include "motion/angles.hpp"
#include "motion/graph/detail/cholesky.hpp"
#include "motion/graph/detail/unknowns.hpp"

namespace sketchloc {
namespace {

using detail::Cholesky;
using detail::LowerPattern;
using detail::Unknowns;

/// The Between edges alone, as a graph of rigid vertices.
PoseGraph relative_part(const PoseGraph& graph) {
  PoseGraph part{.vertices = graph.vertices, .edges = {}};
  part.edges.reserve(graph.edges.size());
  for (const GraphEdge& edge : graph.edges) {
    if (edge.kind == EdgeKind::Between) {
      part.edges.push_back(edge);
    }
  }
  for (GraphVertex& vertex : part.vertices) {
    vertex.kind = VertexKind::Se2;
  }
  return part;
}

/// One number per vertex and one difference per edge: what both linear systems are made of.
class LinearSystem {
 public:
  LinearSystem(const PoseGraph& part, const std::vector<bool>& held)
      : part_(&part),
        unknowns_(part, held, nullptr, std::vector<int>(part.vertices.size(), 1)),
        cholesky_(unknowns_.pattern()) {}

  /// The values v that minimize the sum over the edges of weight |v_second - factor v_first -
  /// offset|^2, where held vertices keep theirs; nothing changes where they are not determined.
  template <typename Value, typename Terms>
  void solve(std::vector<Value>& values, const Terms& terms_of);

 private:
  const PoseGraph* part_;
  Unknowns unknowns_;
  Cholesky cholesky_;
};

template <typename Value>
struct LinearTerms {
  double weight = 0.0;
  Value factor;
  Value offset;
};

double conjugate(double value) { return value; }
std::complex<double> conjugate(const std::complex<double>& value) { return std::conj(value); }

template <typename Value, typename Terms>
void LinearSystem::solve(std::vector<Value>& values, const Terms& terms_of) {
  std::vector<Value> matrix(unknowns_.pattern().rows.size(), Value(0.0));
  Eigen::Matrix<Value, Eigen::Dynamic, 1> right(unknowns_.size());
  right.setZero();
  const auto entry = [&](std::size_t a, std::size_t b) -> Value& {
    return matrix[static_cast<std::size_t>(unknowns_.slot(a, b).base)];
  };
  for (const GraphEdge& edge : part_->edges) {
    const LinearTerms<Value> terms = terms_of(edge);
    const std::size_t i = edge.first;
    const std::size_t j = edge.second;
    const Value back = terms.weight * conjugate(terms.factor);
    if (unknowns_.moves(i)) {
      entry(i, i) += terms.weight * std::norm(terms.factor);  // exactly real, as CHOLMOD wants it
      right[unknowns_.offset(i)] +=
          back * ((unknowns_.moves(j) ? Value(0.0) : values[j]) - terms.offset);
    }
    if (unknowns_.moves(j)) {
      entry(j, j) += terms.weight;
      right[unknowns_.offset(j)] +=
          terms.weight *
          ((unknowns_.moves(i) ? Value(0.0) : terms.factor * values[i]) + terms.offset);
    }
    if (unknowns_.moves(i) && unknowns_.moves(j)) {  // row of the one that is eliminated later
      entry(i, j) -= unknowns_.offset(i) > unknowns_.offset(j) ? back : conjugate(back);
    }
  }
  if (!cholesky_.factorise(std::span<const Value>(matrix))) {
    return;
  }
  const Eigen::Matrix<Value, Eigen::Dynamic, 1> solution = cholesky_.solve(right);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (unknowns_.moves(i)) {
      values[i] = solution[unknowns_.offset(i)];
    }
  }
}

/// Headings by the chordal relaxation: unit complex numbers without the constraint on their length
/// [Carlone15], then those nearest to them that agree best with the edges, in least squares.
void turn_headings(LinearSystem& system, const std::vector<bool>& held,
                   std::vector<GraphPose>& poses) {
  using Complex = std::complex<double>;
  std::vector<Complex> directions;
  for (const GraphPose& pose : poses) {
    directions.push_back(std::polar(1.0, pose.yaw_rad));
  }
  system.solve(directions, [](const GraphEdge& edge) {
    return LinearTerms<Complex>{.weight = edge.information(2, 2),
                                .factor = std::polar(1.0, edge.measured.yaw_rad),
                                .offset = 0.0};
  });
  std::vector<double> corrections(poses.size(), 0.0);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].yaw_rad = held[i] ? poses[i].yaw_rad : std::arg(directions[i]);
  }
  system.solve(corrections, [&](const GraphEdge& edge) {
    return LinearTerms<double>{
        .weight = edge.information(2, 2),
        .factor = 1.0,
        .offset = wrap_rad(poses[edge.first].yaw_rad + edge.measured.yaw_rad -
                           poses[edge.second].yaw_rad)};
  });
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].yaw_rad = held[i] ? poses[i].yaw_rad : wrap_rad(poses[i].yaw_rad + corrections[i]);
  }
}

/// Positions as complex numbers, once the headings are known.
void place(LinearSystem& system, std::vector<GraphPose>& poses) {
  using Complex = std::complex<double>;
  std::vector<Complex> positions;
  for (const GraphPose& pose : poses) {
    positions.emplace_back(pose.x, pose.y);
  }
  system.solve(positions, [&](const GraphEdge& edge) {
    const GraphPose& first = poses[edge.first];
    const Complex turn = std::polar(std::exp(first.log_scale), first.yaw_rad);
    return LinearTerms<Complex>{.weight = edge.information.diagonal().head<2>().mean(),
                                .factor = 1.0,
                                .offset = turn * Complex(edge.measured.x, edge.measured.y)};
  });
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].x = positions[i].real();
    poses[i].y = positions[i].imag();
  }
}

}  // namespace

std::vector<GraphPose> linear_start(const PoseGraph& graph) {
  std::vector<GraphPose> poses;
  for (const GraphVertex& vertex : graph.vertices) {
    poses.push_back(vertex.frame_from_body);
  }
  const PoseGraph part = relative_part(graph);
  const std::vector<bool> held = detail::held_vertices(part);
  if (std::ranges::count(held, false) == 0) {
    return poses;
  }
  LinearSystem system(part, held);
  turn_headings(system, held, poses);
  place(system, poses);
  return poses;
}

std::vector<GraphPose> dead_reckoning(const PoseGraph& graph) {
  std::vector<GraphPose> poses;
  for (const GraphVertex& vertex : graph.vertices) {
    poses.push_back(vertex.frame_from_body);
  }
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> edge_to(poses.size(), kNone);  // from the vertex before
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const GraphEdge& edge = graph.edges[i];
    const std::size_t later = std::max(edge.first, edge.second);
    const bool is_step =
        edge.kind == EdgeKind::Between && edge.first + edge.second + 1 == 2 * later;
    if (is_step && edge_to[later] == kNone) {
      edge_to[later] = i;
    }
  }
  for (std::size_t i = 1; i < poses.size(); ++i) {
    if (edge_to[i] != kNone) {
      const GraphEdge& edge = graph.edges[edge_to[i]];
      const GraphPose step =
          edge.first < edge.second ? edge.measured : between(edge.measured, GraphPose{});
      poses[i] = compose(poses[i - 1], step);
    }
  }
  return poses;
}

}  // namespace sketchloc
