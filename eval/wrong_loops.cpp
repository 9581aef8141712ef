#include "eval/wrong_loops.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/check.hpp"

namespace sketchloc {
namespace {

std::size_t random_index(std::size_t count, Rng& rng) {
  return static_cast<std::size_t>(uniform(0.0, static_cast<double>(count), rng));
}

}  // namespace

PoseGraph with_wrong_loops(PoseGraph graph, double share, Rng& rng) {
  check(share >= 0.0 && share < 1.0, "a share of wrong loops from 0 to below 1");
  std::vector<GraphEdge> loops;
  for (const GraphEdge& edge : graph.edges) {
    if (edge.may_be_wrong && edge.kind == EdgeKind::Between) {
      loops.push_back(edge);
    }
  }
  if (loops.empty() || graph.vertices.size() < 3) {
    return graph;
  }
  const auto wrong = static_cast<std::size_t>(
      std::llround(share / (1.0 - share) * static_cast<double>(loops.size())));
  for (std::size_t i = 0; i < wrong; ++i) {
    GraphEdge edge = loops[random_index(loops.size(), rng)];
    do {
      edge.first = random_index(graph.vertices.size(), rng);
      edge.second = random_index(graph.vertices.size(), rng);
    } while (std::max(edge.first, edge.second) - std::min(edge.first, edge.second) < 2);
    graph.edges.push_back(edge);
  }
  return graph;
}

}  // namespace sketchloc
