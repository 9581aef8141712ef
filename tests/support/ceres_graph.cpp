#include "tests/support/ceres_graph.hpp"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>

namespace sketchloc::testing {
namespace {

using Block = std::array<double, 3>;
using RowMatrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// L^T r with information L L^T, r = inverse(measured) * inverse(first) * second.
class RelativePose : public ceres::SizedCostFunction<3, 3, 3> {
 public:
  RelativePose(const GraphPose& measured, const Eigen::Matrix3d& information)
      : measured_(measured), root_(information.llt().matrixL().transpose()) {
    Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
    const double cosine = std::cos(measured.yaw_rad);
    const double sine = std::sin(measured.yaw_rad);
    turn.topLeftCorner<2, 2>() << cosine, sine, -sine, cosine;
    root_ = root_ * turn;
  }

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    const double* first = blocks[0];
    const double* second = blocks[1];
    const double cosine = std::cos(first[2]);
    const double sine = std::sin(first[2]);
    const double dx = second[0] - first[0];
    const double dy = second[1] - first[1];
    const double ahead = cosine * dx + sine * dy;
    const double left = cosine * dy - sine * dx;
    const double turn = second[2] - first[2] - measured_.yaw_rad;
    constexpr double kFull = 2.0 * std::numbers::pi;
    Eigen::Map<Eigen::Vector3d>(residuals).noalias() =
        root_ * Eigen::Vector3d(ahead - measured_.x, left - measured_.y,
                                turn - kFull * std::floor(turn / kFull + 0.5));
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Matrix3d by_first;
      by_first << -cosine, -sine, left, sine, -cosine, -ahead, 0.0, 0.0, -1.0;
      Eigen::Map<RowMatrix>(jacobians[0]).noalias() = root_ * by_first;
    }
    if (jacobians != nullptr && jacobians[1] != nullptr) {
      Eigen::Matrix3d by_second;
      by_second << cosine, sine, 0.0, -sine, cosine, 0.0, 0.0, 0.0, 1.0;
      Eigen::Map<RowMatrix>(jacobians[1]).noalias() = root_ * by_second;
    }
    return true;
  }

 private:
  GraphPose measured_;
  Eigen::Matrix3d root_;
};

/// A graph as Ceres wants it.
class GraphProblem {
 public:
  explicit GraphProblem(const PoseGraph& graph) : problem_(options()) {
    for (const GraphVertex& vertex : graph.vertices) {
      const GraphPose& pose = vertex.frame_from_body;
      blocks_.push_back({pose.x, pose.y, pose.yaw_rad});
    }
    for (const GraphEdge& edge : graph.edges) {
      costs_.emplace_back(edge.measured, edge.information.topLeftCorner<3, 3>());
      problem_.AddResidualBlock(&costs_.back(), nullptr, blocks_[edge.first].data(),
                                blocks_[edge.second].data());
    }
    bool has_fixed = false;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      if (graph.vertices[i].is_fixed) {
        problem_.SetParameterBlockConstant(blocks_[i].data());
        has_fixed = true;
      }
    }
    if (!has_fixed) {
      problem_.SetParameterBlockConstant(blocks_.front().data());
    }
  }

  ceres::Problem& problem() { return problem_; }
  const Block& block(std::size_t vertex) const { return blocks_[vertex]; }
  std::size_t size() const { return blocks_.size(); }

 private:
  static ceres::Problem::Options options() {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.disable_all_safety_checks = true;
    return options;
  }

  std::vector<Block> blocks_;
  std::deque<RelativePose> costs_;  ///< not to be moved
  ceres::Problem problem_;
};

}  // namespace

CeresAnswer ceres_optimum(const PoseGraph& graph, double cost_tolerance) {
  GraphProblem graph_problem(graph);
  ceres::Solver::Options options;
  options.trust_region_strategy_type = ceres::DOGLEG;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  options.num_threads = 1;
  options.max_num_iterations = 200;
  options.function_tolerance = cost_tolerance;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &graph_problem.problem(), &summary);
  CeresAnswer answer{.poses = {},
                     .chi2 = 2.0 * summary.final_cost,  // Ceres halves the squares
                     .iterations = summary.num_linear_solves};
  for (std::size_t i = 0; i < graph_problem.size(); ++i) {
    const Block& block = graph_problem.block(i);
    answer.poses.push_back({.x = block[0], .y = block[1], .yaw_rad = block[2]});
  }
  return answer;
}

std::vector<Eigen::Matrix3d> ceres_covariances(const PoseGraph& graph,
                                               const std::vector<std::size_t>& vertices) {
  GraphProblem graph_problem(graph);
  std::vector<std::pair<const double*, const double*>> pairs;
  for (const std::size_t vertex : vertices) {
    const double* block = graph_problem.block(vertex).data();
    pairs.emplace_back(block, block);
  }
  ceres::Covariance covariance({});
  std::vector<Eigen::Matrix3d> result;
  if (!covariance.Compute(pairs, &graph_problem.problem())) {
    return result;
  }
  for (const auto& [block, same] : pairs) {
    RowMatrix marginal;
    covariance.GetCovarianceBlock(block, same, marginal.data());
    result.emplace_back(marginal);
  }
  return result;
}

}  // namespace sketchloc::testing
