#include "motion/graph/detail/normal_equations.hpp"

#include <algorithm>

namespace sketchloc::detail {
namespace {

/// Adds a block to the lower triangle; of a block on the diagonal only its own lower triangle.
template <int kSize>
void add_block(std::vector<double>& values, const Unknowns::Slot& slot,
               const Eigen::Matrix<double, kSize, kSize>& block, int rows, int columns,
               bool is_diagonal) {
  for (int column = 0; column < columns; ++column) {
    double* entry = values.data() + slot.at(0, column);
    for (int row = is_diagonal ? column : 0; row < rows; ++row) {
      entry[row] += block(row, column);
    }
  }
}

}  // namespace

std::vector<GraphPose> poses_of(const PoseGraph& graph) {
  std::vector<GraphPose> poses;
  poses.reserve(graph.vertices.size());
  for (const GraphVertex& vertex : graph.vertices) {
    poses.push_back(vertex.frame_from_body);
  }
  return poses;
}

NormalEquations::NormalEquations(const PoseGraph& graph, const std::vector<bool>& held,
                                 const DensePrior* prior, const std::vector<bool>& joins)
    : graph_(&graph),
      prior_(prior),
      unknowns_(graph, held, prior, block_sizes(graph), joins),
      turned_(graph.vertices.size()),
      values_(unknowns_.pattern().rows.size()),
      gradient_(unknowns_.size()) {
  is_rigid_ = std::ranges::all_of(graph.vertices, [](const GraphVertex& vertex) {
    return vertex.kind == VertexKind::Se2 && vertex.frame_from_body.log_scale == 0.0;
  });
  information_.reserve(graph.edges.size());
  slots_.reserve(graph.edges.size());
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const GraphEdge& edge = graph.edges[i];
    information_.push_back(turned_information(edge));
    EdgeSlots slots;
    const bool first_moves = unknowns_.moves(edge.first);
    const bool second_moves = edge.second != edge.first && unknowns_.moves(edge.second);
    if (first_moves) {
      slots.first = unknowns_.slot(edge.first, edge.first);
    }
    if (second_moves) {
      slots.second = unknowns_.slot(edge.second, edge.second);
    }
    if (first_moves && second_moves && (joins.empty() || joins[i])) {
      slots.both = unknowns_.slot(edge.first, edge.second);
      slots.first_is_column = unknowns_.offset(edge.first) < unknowns_.offset(edge.second);
    }
    slots_.push_back(slots);
  }
}

void NormalEquations::turn(std::span<const GraphPose> poses) const {
  std::ranges::transform(poses, turned_.begin(), turned);
}

double NormalEquations::weight(std::size_t edge, double chi2,
                               const EdgeWeighting& weighting) const {
  const double given = weighting.given.empty() ? 1.0 : weighting.given[edge];
  return graph_->edges[edge].may_be_wrong ? given * robust_weight(weighting.kernel, chi2) : given;
}

Eigen::VectorXd NormalEquations::prior_difference(std::span<const GraphPose> poses) const {
  Eigen::VectorXd all(prior_->gradient.size());
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < prior_->vertices.size(); ++i) {
    const std::size_t vertex = prior_->vertices[i];
    const int size = unknowns_.size_of(vertex);
    all.segment(row, size) = difference(poses[vertex], prior_->reference[i]).head(size);
    row += size;
  }
  return all;
}

std::vector<double> NormalEquations::chi2_of_edges(std::span<const GraphPose> poses) const {
  turn(poses);
  std::vector<double> chi2;
  chi2.reserve(graph_->edges.size());
  for (std::size_t i = 0; i < graph_->edges.size(); ++i) {
    const GraphEdge& edge = graph_->edges[i];
    const Eigen::Vector4d error = error_of(edge, turned_[edge.first], turned_[edge.second]);
    chi2.push_back(error.dot(information_[i] * error));
  }
  return chi2;
}

std::vector<double> NormalEquations::weights(std::span<const GraphPose> poses,
                                             const EdgeWeighting& weighting) const {
  std::vector<double> weights = chi2_of_edges(poses);
  for (std::size_t i = 0; i < weights.size(); ++i) {
    weights[i] = weight(i, weights[i], weighting);
  }
  return weights;
}

double NormalEquations::cost(std::span<const GraphPose> poses,
                             const EdgeWeighting& weighting) const {
  turn(poses);
  double sum = 0.0;
  for (std::size_t i = 0; i < graph_->edges.size(); ++i) {
    const GraphEdge& edge = graph_->edges[i];
    const Eigen::Vector4d error = error_of(edge, turned_[edge.first], turned_[edge.second]);
    const double chi2 = error.dot(information_[i] * error);
    const double given = weighting.given.empty() ? 1.0 : weighting.given[i];
    sum += given * (edge.may_be_wrong ? robust_cost(weighting.kernel, chi2) : chi2);
  }
  if (prior_ != nullptr) {
    const Eigen::VectorXd e = prior_difference(poses);
    sum += e.dot(prior_->information * e) + 2.0 * prior_->gradient.dot(e);
  }
  return sum;
}

template <int kSize>
void NormalEquations::add_edge(std::size_t index, const EdgeWeighting& weighting) {
  using Block = Eigen::Matrix<double, kSize, kSize>;
  using Vector = Eigen::Matrix<double, kSize, 1>;
  const GraphEdge& edge = graph_->edges[index];
  const LinearEdge linear = linearised(edge, turned_[edge.first], turned_[edge.second]);
  const Vector error = linear.error.head<kSize>();
  const Block information = information_[index].topLeftCorner<kSize, kSize>();
  const Vector informed_error = information * error;
  const double w = weight(index, error.dot(informed_error), weighting);
  if (w == 0.0) {
    return;
  }
  const Block by_first = linear.by_first.topLeftCorner<kSize, kSize>();
  const Block by_second = linear.by_second.topLeftCorner<kSize, kSize>();
  const Block informed_first = w * information * by_first;
  const Block informed_second = w * information * by_second;
  const EdgeSlots& slots = slots_[index];
  const int first_size = unknowns_.size_of(edge.first);
  const int second_size = unknowns_.size_of(edge.second);
  if (slots.first.base >= 0) {
    add_block<kSize>(values_, slots.first, by_first.transpose() * informed_first, first_size,
                     first_size, true);
    const Vector part = w * by_first.transpose() * informed_error;
    gradient_.segment(unknowns_.offset(edge.first), first_size) += part.head(first_size);
  }
  if (slots.second.base >= 0) {
    add_block<kSize>(values_, slots.second, by_second.transpose() * informed_second, second_size,
                     second_size, true);
    const Vector part = w * by_second.transpose() * informed_error;
    gradient_.segment(unknowns_.offset(edge.second), second_size) += part.head(second_size);
  }
  if (slots.both.base >= 0 && slots.first_is_column) {
    add_block<kSize>(values_, slots.both, by_second.transpose() * informed_first, second_size,
                     first_size, false);
  } else if (slots.both.base >= 0) {
    add_block<kSize>(values_, slots.both, by_first.transpose() * informed_second, first_size,
                     second_size, false);
  }
}

void NormalEquations::add_prior(std::span<const GraphPose> poses) {
  const Eigen::VectorXd slope = prior_->gradient + prior_->information * prior_difference(poses);
  Eigen::Index row = 0;
  for (const std::size_t vertex : prior_->vertices) {
    const int size = unknowns_.size_of(vertex);
    Eigen::Index column = 0;
    for (const std::size_t other : prior_->vertices) {
      const int other_size = unknowns_.size_of(other);
      // Each pair of blocks once: the one whose columns come first.
      if (unknowns_.moves(vertex) && unknowns_.moves(other) &&
          unknowns_.offset(other) <= unknowns_.offset(vertex)) {
        Eigen::Matrix4d block = Eigen::Matrix4d::Zero();
        block.topLeftCorner(size, other_size) =
            prior_->information.block(row, column, size, other_size);
        add_block<4>(values_, unknowns_.slot(vertex, other), block, size, other_size,
                     vertex == other);
      }
      column += other_size;
    }
    if (unknowns_.moves(vertex)) {
      gradient_.segment(unknowns_.offset(vertex), size) += slope.segment(row, size);
    }
    row += size;
  }
}

void NormalEquations::linearise(std::span<const GraphPose> poses, const EdgeWeighting& weighting) {
  turn(poses);
  std::ranges::fill(values_, 0.0);
  gradient_.setZero();
  for (std::size_t i = 0; i < graph_->edges.size(); ++i) {
    if (is_rigid_) {
      add_edge<3>(i, weighting);
    } else {
      add_edge<4>(i, weighting);
    }
  }
  if (prior_ != nullptr) {
    add_prior(poses);
  }
}

Eigen::VectorXd NormalEquations::diagonal() const {
  Eigen::VectorXd diagonal(unknowns_.size());
  for (int i = 0; i < unknowns_.size(); ++i) {
    const int start = unknowns_.pattern().column_starts[static_cast<std::size_t>(i)];
    diagonal[i] = values_[static_cast<std::size_t>(start)];
  }
  return diagonal;
}

void NormalEquations::add_to_diagonal(const Eigen::VectorXd& damping) {
  for (int i = 0; i < unknowns_.size(); ++i) {
    const int start = unknowns_.pattern().column_starts[static_cast<std::size_t>(i)];
    values_[static_cast<std::size_t>(start)] += damping[i];
  }
}

double NormalEquations::curvature(const Eigen::VectorXd& step) const {
  const LowerPattern& pattern = unknowns_.pattern();
  double sum = 0.0;
  for (int column = 0; column < pattern.size(); ++column) {
    const auto start =
        static_cast<std::size_t>(pattern.column_starts[static_cast<std::size_t>(column)]);
    const auto end =
        static_cast<std::size_t>(pattern.column_starts[static_cast<std::size_t>(column) + 1]);
    double below = 0.0;
    for (std::size_t i = start + 1; i < end; ++i) {
      below += values_[i] * step[pattern.rows[i]];
    }
    sum += step[column] * (values_[start] * step[column] + 2.0 * below);
  }
  return sum;
}

std::vector<GraphPose> NormalEquations::moved(std::span<const GraphPose> poses,
                                              const Eigen::VectorXd& step) const {
  std::vector<GraphPose> result(poses.begin(), poses.end());
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (unknowns_.moves(i)) {
      const int offset = unknowns_.offset(i);
      result[i].x += step[offset];
      result[i].y += step[offset + 1];
      result[i].yaw_rad += step[offset + 2];
      result[i].log_scale += unknowns_.size_of(i) == 4 ? step[offset + 3] : 0.0;
    }
  }
  return result;
}

}  // namespace sketchloc::detail
