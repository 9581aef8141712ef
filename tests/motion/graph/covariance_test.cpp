#include "motion/graph/covariance.hpp"

#include <gtest/gtest.h>

#include "motion/graph/optimise.hpp"
#include "tests/support/ceres_graph.hpp"
#include "tests/support/graphs.hpp"

namespace sketchloc {
namespace {

TEST(Covariances, AreThoseThatCeresGives) {
  Rng rng = make_rng(1);
  PoseGraph graph = testing::simulated_graph(80, 0.5, rng).measured;
  graph = with_poses(graph, optimise(graph).poses);
  const std::vector<std::size_t> vertices = {1, 20, 79};
  const std::vector<Eigen::Matrix3d> expected = testing::ceres_covariances(graph, vertices);
  const auto found = covariances(graph, vertices);
  ASSERT_TRUE(found);
  ASSERT_EQ(expected.size(), 3U);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    EXPECT_TRUE((*found)[i].isApprox(expected[i], 1e-6)) << (*found)[i] << "\n\n" << expected[i];
  }
}

/// x alone: a chain of variances 1/4 each, closed by one of 1/2.
TEST(Covariances, AreExactOnALine) {
  PoseGraph graph;
  graph.vertices.resize(3);
  const Eigen::Matrix3d information = Eigen::Vector3d(4.0, 1.0, 1.0).asDiagonal();
  const Eigen::Matrix3d weaker = Eigen::Vector3d(2.0, 1.0, 1.0).asDiagonal();
  graph.edges = {between_edge(0, 1, Se2(), information), between_edge(1, 2, Se2(), information),
                 between_edge(0, 2, Se2(), weaker)};
  const std::vector<std::size_t> vertices = {0, 1, 2};
  const auto found = covariances(graph, vertices);
  ASSERT_TRUE(found);
  EXPECT_TRUE((*found)[0].isZero());
  EXPECT_NEAR((*found)[2](0, 0), 1.0 / (1.0 / 0.5 + 2.0), 1e-12);  // two ways, side by side
  EXPECT_NEAR((*found)[1](0, 0), 1.0 / (4.0 + 1.0 / (0.25 + 0.5)), 1e-12);
}

TEST(Covariances, LeaveOutEdgesThatWeighNothing) {
  PoseGraph graph;
  graph.vertices.resize(2);
  const Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
  graph.edges = {between_edge(0, 1, Se2(), information), between_edge(0, 1, Se2(), information)};
  const std::vector<std::size_t> vertices = {1};
  const std::vector<double> weights = {1.0, 0.0};
  EXPECT_NEAR((*covariances(graph, vertices))[0](0, 0), 0.5, 1e-12);
  EXPECT_NEAR((*covariances(graph, vertices, weights))[0](0, 0), 1.0, 1e-12);
}

TEST(Covariances, AreNoneWhereTheEdgesDetermineNothing) {
  PoseGraph graph;
  graph.vertices.resize(2);
  graph.edges = {between_edge(0, 1, Se2(), Eigen::Vector3d(0.0, 1.0, 1.0).asDiagonal())};
  const std::vector<std::size_t> vertices = {1};
  EXPECT_FALSE(covariances(graph, vertices));
}

}  // namespace
}  // namespace sketchloc
