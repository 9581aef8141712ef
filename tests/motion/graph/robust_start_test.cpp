#include "motion/graph/robust_start.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motion/graph/detail/agreement.hpp"
#include "motion/graph/detail/graduation.hpp"
#include "motion/graph/linear_start.hpp"
#include "motion/graph/optimise.hpp"
#include "tests/support/graphs.hpp"

namespace sketchloc {
namespace {

constexpr double kWidth = 3.37;

/// Two straight passes of ten poses in opposite directions, side by side.
PoseGraph two_passes() {
  PoseGraph graph;
  const Eigen::Matrix3d information = Eigen::Vector3d(400.0, 400.0, 2500.0).asDiagonal();
  for (std::size_t i = 0; i < 20; ++i) {
    GraphVertex& vertex = graph.vertices.emplace_back();
    const double x = i < 10 ? static_cast<double>(i) : static_cast<double>(19 - i);
    vertex.frame_from_body = {.x = x, .y = i < 10 ? 0.0 : 1.0, .yaw_rad = i < 10 ? 0.0 : 3.1};
    if (i > 0) {
      graph.edges.push_back(between_edge(
          i - 1, i, to_se2(between(graph.vertices[i - 1].frame_from_body, vertex.frame_from_body)),
          information));
    }
  }
  return graph;
}

GraphEdge loop(const PoseGraph& graph, std::size_t first, std::size_t second, double off_m = 0.0) {
  GraphPose measured =
      between(graph.vertices[first].frame_from_body, graph.vertices[second].frame_from_body);
  measured.x += off_m;
  GraphEdge edge = between_edge(first, second, to_se2(measured),
                                Eigen::Vector3d(400.0, 400.0, 2500.0).asDiagonal());
  edge.may_be_wrong = true;
  return edge;
}

TEST(Agreement, LoopsNearEachOtherThatCloseAreEachOthersWitnesses) {
  PoseGraph graph = two_passes();
  const std::size_t steps = graph.edges.size();
  graph.edges.push_back(loop(graph, 1, 18));
  graph.edges.push_back(loop(graph, 16, 3));  // in the other direction
  graph.edges.push_back(loop(graph, 4, 15, 3.0));
  const std::vector<int> agreeing =
      detail::agreeing_edges(graph.edges, graph.vertices.size(), kWidth);
  EXPECT_EQ(std::ranges::count(agreeing, 0), static_cast<std::ptrdiff_t>(steps) + 1);
  EXPECT_EQ(agreeing[steps], 1);
  EXPECT_EQ(agreeing[steps + 1], 1);
  EXPECT_EQ(agreeing[steps + 2], 0);
}

TEST(Agreement, LoopsFarFromEachOtherSayNothingOfEachOther) {
  Rng rng = make_rng(2);
  PoseGraph graph = testing::simulated_graph(200, 0.0, rng).measured;
  const std::size_t steps = graph.edges.size();
  graph.edges.push_back(loop(graph, 5, 100));
  graph.edges.push_back(loop(graph, 5, 150));
  graph.edges.push_back(loop(graph, 30, 100));
  for (const int count : detail::agreeing_edges(graph.edges, graph.vertices.size(), kWidth)) {
    EXPECT_EQ(count, 0);
  }
  EXPECT_EQ(graph.edges.size(), steps + 3);
}

TEST(Graduation, WeightsAreWholeBelowNoneAboveAndSteadyBetween) {
  constexpr double kBound = 4.0;
  for (const double mu : {0.01, 1.0, 100.0}) {
    const double low = mu / (mu + 1.0) * kBound;
    const double high = (mu + 1.0) / mu * kBound;
    EXPECT_EQ(detail::graduated_weight(0.9 * low, kBound, mu), 1.0);
    EXPECT_NEAR(detail::graduated_weight(1.000001 * low, kBound, mu), 1.0, 1e-4);
    EXPECT_NEAR(detail::graduated_weight(0.999999 * high, kBound, mu), 0.0, 1e-4);
    EXPECT_EQ(detail::graduated_weight(1.1 * high, kBound, mu), 0.0);
  }
}

TEST(Graduation, TheConvexProblemCutsNothingOff) {
  const std::vector<double> chi2s = {1.0, 400.0, 30.0};
  const double mu = detail::convex_mu(chi2s, 4.0);
  EXPECT_GT(mu, 0.0);
  EXPECT_GT(detail::graduated_weight(400.0, 4.0, mu), 0.0);
  EXPECT_EQ(detail::convex_mu(std::vector<double>{1.0, 3.9}, 4.0), 0.0);
  EXPECT_EQ(detail::convex_mu({}, 4.0), 0.0);
}

TEST(RobustStart, StandsNearTheOptimumThoughHalfOfTheLoopsAreWrong) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    Rng rng = make_rng(seed);
    const PoseGraph right = testing::simulated_graph(600, 0.5, rng).measured;
    const PoseGraph wrong = testing::with_random_loops(right, testing::doubted(right), rng);
    const std::vector<GraphPose> optimum = optimise(right).poses;
    EXPECT_LT(testing::worst_distance_m(robust_start(wrong, kWidth, 2), optimum), 5.0);
    EXPECT_GT(testing::worst_distance_m(linear_start(wrong), optimum), 15.0);
  }
}

TEST(RobustStart, WithoutWitnessesTheSureEdgesAloneSayWhereThePosesAre) {
  Rng rng = make_rng(4);
  PoseGraph graph = testing::simulated_graph(100, 0.0, rng).measured;
  graph.edges.push_back(loop(graph, 5, 90, 20.0));
  const std::vector<GraphPose> poses = robust_start(graph, kWidth, 1);
  EXPECT_LT(testing::worst_distance_m(poses, dead_reckoning(graph)), 1e-6);
}

TEST(RobustStart, LeavesAnEmptyGraphAsItIs) { EXPECT_TRUE(robust_start({}, kWidth, 2).empty()); }

}  // namespace
}  // namespace sketchloc
