#include "motion/graph/detail/linear_poses.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

#include "motion/angles.hpp"
#include "motion/check.hpp"
#include "motion/graph/detail/unknowns.hpp"

namespace sketchloc::detail {
namespace {

using Complex = std::complex<double>;

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

/// What one edge says: value of its second vertex = factor * value of its first + offset.
template <typename Value, int kColumns>
struct LinearTerms {
  double weight = 0.0;
  Value factor = 1.0;
  Eigen::Matrix<Value, 1, kColumns> offset = Eigen::Matrix<Value, 1, kColumns>::Zero();
};

template <typename Value, int kColumns>
using Values = Eigen::Matrix<Value, Eigen::Dynamic, kColumns>;

double conjugate(double value) { return value; }
Complex conjugate(const Complex& value) { return std::conj(value); }

/// One row of numbers per vertex and one difference per edge: what all these systems are made of.
class LinearSystem {
 public:
  /// Of the edges that `counts` says.
  LinearSystem(const PoseGraph& part, const std::vector<bool>& held, std::vector<bool> counts)
      : part_(&part),
        counts_(std::move(counts)),
        unknowns_(part, held, nullptr, std::vector<int>(part.vertices.size(), 1), counts_),
        cholesky_(unknowns_.pattern()) {}

  const std::vector<bool>& counts() const { return counts_; }

  /// The values v that minimize the sum over the edges of weight |v_second - factor v_first -
  /// offset|^2, where held vertices keep theirs; nothing changes where they are not determined.
  template <typename Value, int kColumns, typename Terms>
  void solve(Values<Value, kColumns>& values, const Terms& terms_of);

 private:
  const PoseGraph* part_;
  std::vector<bool> counts_;
  Unknowns unknowns_;
  Cholesky cholesky_;
};

template <typename Value, int kColumns, typename Terms>
void LinearSystem::solve(Values<Value, kColumns>& values, const Terms& terms_of) {
  using Row = Eigen::Matrix<Value, 1, kColumns>;
  std::vector<Value> matrix(unknowns_.pattern().rows.size(), Value(0.0));
  Values<Value, kColumns> right = Values<Value, kColumns>::Zero(unknowns_.size(), kColumns);
  const auto entry = [&](std::size_t a, std::size_t b) -> Value& {
    return matrix[static_cast<std::size_t>(unknowns_.slot(a, b).base)];
  };
  for (std::size_t index = 0; index < part_->edges.size(); ++index) {
    if (!counts_[index]) {
      continue;
    }
    const LinearTerms<Value, kColumns> terms = terms_of(index);
    const std::size_t i = part_->edges[index].first;
    const std::size_t j = part_->edges[index].second;
    const Value back = terms.weight * conjugate(terms.factor);
    if (unknowns_.moves(i)) {
      entry(i, i) += terms.weight * std::norm(terms.factor);  // exactly real, as CHOLMOD wants it
      const Row known = unknowns_.moves(j) ? Row(Row::Zero()) : Row(values.row(Eigen::Index(j)));
      right.row(unknowns_.offset(i)) += back * (known - terms.offset);
    }
    if (unknowns_.moves(j)) {
      entry(j, j) += terms.weight;
      const Row known =
          unknowns_.moves(i) ? Row(Row::Zero()) : Row(terms.factor * values.row(Eigen::Index(i)));
      right.row(unknowns_.offset(j)) += terms.weight * (known + terms.offset);
    }
    if (unknowns_.moves(i) && unknowns_.moves(j)) {  // row of the one that is eliminated later
      entry(i, j) -= unknowns_.offset(i) > unknowns_.offset(j) ? back : conjugate(back);
    }
  }
  if (!cholesky_.factorise(std::span<const Value>(matrix))) {
    return;
  }
  const Values<Value, kColumns> solution = cholesky_.solve(right);
  for (std::size_t i = 0; i < part_->vertices.size(); ++i) {
    if (unknowns_.moves(i)) {
      values.row(Eigen::Index(i)) = solution.row(unknowns_.offset(i));
    }
  }
}

}  // namespace

struct LinearPoses::Parts {
  PoseGraph part;
  std::vector<bool> held;
  std::vector<GraphPose> poses;
  std::optional<LinearSystem> system;

  LinearSystem& system_of(std::span<const double> weights);
  /// What the headings leave of an edge.
  double heading_error_rad(const GraphEdge& edge) const {
    return wrap_rad(poses[edge.first].yaw_rad + edge.measured.yaw_rad - poses[edge.second].yaw_rad);
  }
  /// The step of an edge, in the frame of the graph.
  Eigen::RowVector2d step_of(const GraphEdge& edge) const {
    const GraphPose& first = poses[edge.first];
    const Complex step = std::polar(std::exp(first.log_scale), first.yaw_rad) *
                         Complex(edge.measured.x, edge.measured.y);
    return {step.real(), step.imag()};
  }
};

namespace {

double position_information(const GraphEdge& edge) {
  return edge.information.diagonal().head<2>().mean();
}

}  // namespace

/// The one there is, as long as the same edges count.
LinearSystem& LinearPoses::Parts::system_of(std::span<const double> weights) {
  check(weights.size() == part.edges.size(), "one weight per edge");
  std::vector<bool> counts(weights.size());
  std::transform(weights.begin(), weights.end(), counts.begin(),
                 [](double weight) { return weight > 0.0; });
  if (!system || system->counts() != counts) {
    system.emplace(part, held, std::move(counts));
  }
  return *system;
}

LinearPoses::LinearPoses(const PoseGraph& graph) : parts_(std::make_unique<Parts>()) {
  parts_->part = relative_part(graph);
  parts_->held = held_vertices(parts_->part);
  for (const GraphVertex& vertex : graph.vertices) {
    parts_->poses.push_back(vertex.frame_from_body);
  }
}
LinearPoses::~LinearPoses() = default;

std::span<const GraphEdge> LinearPoses::edges() const { return parts_->part.edges; }
const std::vector<GraphPose>& LinearPoses::poses() const { return parts_->poses; }

void LinearPoses::turn(std::span<const double> weights) {
  std::vector<GraphPose>& poses = parts_->poses;
  Values<Complex, 1> directions(Eigen::Index(poses.size()));
  for (std::size_t i = 0; i < poses.size(); ++i) {
    directions[Eigen::Index(i)] = std::polar(1.0, poses[i].yaw_rad);
  }
  parts_->system_of(weights).solve(directions, [&](std::size_t index) {
    const GraphEdge& edge = edges()[index];
    return LinearTerms<Complex, 1>{.weight = weights[index] * edge.information(2, 2),
                                   .factor = std::polar(1.0, edge.measured.yaw_rad)};
  });
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!parts_->held[i]) {
      poses[i].yaw_rad = std::arg(directions[Eigen::Index(i)]);
    }
  }
}

void LinearPoses::straighten(std::span<const double> weights) {
  std::vector<GraphPose>& poses = parts_->poses;
  Values<double, 1> corrections = Values<double, 1>::Zero(Eigen::Index(poses.size()));
  parts_->system_of(weights).solve(corrections, [&](std::size_t index) {
    const GraphEdge& edge = edges()[index];
    LinearTerms<double, 1> terms{.weight = weights[index] * edge.information(2, 2)};
    terms.offset[0] = parts_->heading_error_rad(edge);
    return terms;
  });
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (!parts_->held[i]) {
      poses[i].yaw_rad = wrap_rad(poses[i].yaw_rad + corrections[Eigen::Index(i)]);
    }
  }
}

void LinearPoses::place(std::span<const double> weights) {
  std::vector<GraphPose>& poses = parts_->poses;
  Values<double, 2> positions(Eigen::Index(poses.size()), 2);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    positions.row(Eigen::Index(i)) << poses[i].x, poses[i].y;
  }
  parts_->system_of(weights).solve(positions, [&](std::size_t index) {
    const GraphEdge& edge = edges()[index];
    return LinearTerms<double, 2>{.weight = weights[index] * position_information(edge),
                                  .offset = parts_->step_of(edge)};
  });
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].x = positions(Eigen::Index(i), 0);
    poses[i].y = positions(Eigen::Index(i), 1);
  }
}

std::vector<double> LinearPoses::squared_heading_errors() const {
  std::vector<double> errors;
  for (const GraphEdge& edge : edges()) {
    const double error_rad = parts_->heading_error_rad(edge);
    errors.push_back(edge.information(2, 2) * error_rad * error_rad);
  }
  return errors;
}

std::vector<double> LinearPoses::squared_position_errors() const {
  std::vector<double> errors;
  for (const GraphEdge& edge : edges()) {
    const GraphPose& first = parts_->poses[edge.first];
    const GraphPose& second = parts_->poses[edge.second];
    const Eigen::RowVector2d error =
        Eigen::RowVector2d(second.x - first.x, second.y - first.y) - parts_->step_of(edge);
    errors.push_back(position_information(edge) * error.squaredNorm());
  }
  return errors;
}

}  // namespace sketchloc::detail
