#include "eval/wrong_loops.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace sketchloc {
namespace {

PoseGraph chain_with_loops(std::size_t poses) {
  PoseGraph graph;
  graph.vertices.resize(poses);
  for (std::size_t i = 0; i + 1 < poses; ++i) {
    graph.edges.push_back(
        between_edge(i, i + 1, Se2::from_xy_yaw(1.0, 0.0, 0.0), Eigen::Matrix3d::Identity()));
  }
  for (std::size_t i = 0; i + 10 < poses; ++i) {
    graph.edges.push_back(
        between_edge(i, i + 10, Se2::from_xy_yaw(0.1, 0.0, 0.0), Eigen::Matrix3d::Identity()));
    graph.edges.back().may_be_wrong = true;
  }
  return graph;
}

TEST(WrongLoops, AreTheShareOfAllLoopsThatWasAskedFor) {
  const PoseGraph graph = chain_with_loops(100);
  Rng rng = make_rng(1);
  const PoseGraph spoilt = with_wrong_loops(graph, 0.4, rng);
  const auto loops = std::ranges::count(spoilt.edges, true, &GraphEdge::may_be_wrong);
  EXPECT_EQ(loops, 150);  // 90 right ones, 60 wrong ones
  for (std::size_t i = graph.edges.size(); i < spoilt.edges.size(); ++i) {
    EXPECT_GT(std::max(spoilt.edges[i].first, spoilt.edges[i].second) -
                  std::min(spoilt.edges[i].first, spoilt.edges[i].second),
              1U);
    EXPECT_EQ(spoilt.edges[i].measured.x, 0.1);
  }
}

TEST(WrongLoops, ComeFromTheSeed) {
  const PoseGraph graph = chain_with_loops(50);
  Rng first = make_rng(7);
  Rng second = make_rng(7);
  EXPECT_EQ(with_wrong_loops(graph, 0.3, first), with_wrong_loops(graph, 0.3, second));
}

TEST(WrongLoops, NeedRightOnes) {
  PoseGraph graph = chain_with_loops(5);
  Rng rng = make_rng(1);
  EXPECT_EQ(with_wrong_loops(graph, 0.5, rng), graph);
  EXPECT_EQ(with_wrong_loops(chain_with_loops(50), 0.0, rng), chain_with_loops(50));
}

}  // namespace
}  // namespace sketchloc
