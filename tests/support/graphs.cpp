#include "tests/support/graphs.hpp"

#include <cmath>
#include <numbers>

namespace sketchloc::testing {
namespace {

constexpr double kPositionSigma_m = 0.05;
constexpr double kHeadingSigma_rad = 0.02;

GraphEdge measured_edge(const PoseGraph& truth, std::size_t first, std::size_t second, Rng& rng) {
  const Se2 exact = to_se2(
      between(truth.vertices[first].frame_from_body, truth.vertices[second].frame_from_body));
  const Se2 noisy = Se2::from_xy_yaw(exact.x_m() + gaussian(kPositionSigma_m, rng),
                                     exact.y_m() + gaussian(kPositionSigma_m, rng),
                                     exact.yaw_rad() + gaussian(kHeadingSigma_rad, rng));
  const Eigen::Vector3d sigma(kPositionSigma_m, kPositionSigma_m, kHeadingSigma_rad);
  return between_edge(first, second, noisy, sigma.cwiseAbs2().cwiseInverse().asDiagonal());
}

GraphVertex vertex(std::size_t index, const GraphPose& pose) {
  GraphVertex result;
  result.id = static_cast<std::int64_t>(index);
  result.frame_from_body = pose;
  return result;
}

bool are_neighbours(const PoseGraph& graph, std::size_t a, std::size_t b) {
  const GraphPose& first = graph.vertices[a].frame_from_body;
  const GraphPose& second = graph.vertices[b].frame_from_body;
  return std::hypot(first.x - second.x, first.y - second.y) < 1.2;
}

}  // namespace

SimulatedGraph simulated_graph(std::size_t poses, double loop_chance, Rng& rng) {
  SimulatedGraph graph;
  GraphPose truth;
  GraphPose reckoned;
  for (std::size_t i = 0; i < poses; ++i) {
    graph.truth.vertices.push_back(vertex(i, truth));
    if (i > 0) {
      graph.measured.edges.push_back(measured_edge(graph.truth, i - 1, i, rng));
      reckoned = compose(reckoned, graph.measured.edges.back().measured);
    }
    graph.measured.vertices.push_back(vertex(i, reckoned));
    const double turn = i % 4 == 3 ? std::floor(uniform(-1.0, 2.0, rng)) : 0.0;
    truth = compose(truth, {.x = 1.0, .yaw_rad = turn * std::numbers::pi / 2.0});
  }
  for (std::size_t i = 0; i < poses; ++i) {
    for (std::size_t j = 0; j + 4 < i; ++j) {
      if (are_neighbours(graph.truth, i, j) && uniform(rng) < loop_chance) {
        graph.measured.edges.push_back(measured_edge(graph.truth, j, i, rng));
        graph.measured.edges.back().may_be_wrong = true;
      }
    }
  }
  graph.measured.vertices.front().is_fixed = true;
  return graph;
}

}  // namespace sketchloc::testing
