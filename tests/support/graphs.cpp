#include "tests/support/graphs.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
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

std::size_t doubted(const PoseGraph& graph) {
  return static_cast<std::size_t>(std::ranges::count(graph.edges, true, &GraphEdge::may_be_wrong));
}

PoseGraph with_random_loops(PoseGraph graph, std::size_t count, Rng& rng) {
  std::vector<GraphEdge> loops;
  std::ranges::copy_if(graph.edges, std::back_inserter(loops), &GraphEdge::may_be_wrong);
  const auto random = [&rng](std::size_t below) {
    return static_cast<std::size_t>(uniform(0.0, static_cast<double>(below), rng));
  };
  while (count > 0) {
    GraphEdge edge = loops[random(loops.size())];
    edge.first = random(graph.vertices.size());
    edge.second = random(graph.vertices.size());
    if (edge.first != edge.second) {
      graph.edges.push_back(edge);
      --count;
    }
  }
  return graph;
}

double worst_distance_m(const std::vector<GraphPose>& a, const std::vector<GraphPose>& b) {
  double worst_m = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    worst_m = std::max(worst_m, std::hypot(a[i].x - b[i].x, a[i].y - b[i].y));
  }
  return worst_m;
}

}  // namespace sketchloc::testing
