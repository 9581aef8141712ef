#include "motion/graph/linear_start.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "motion/graph/optimise.hpp"
#include "tests/support/graphs.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;

/// Exact measurements around a circle that is driven several times.
PoseGraph exact_circles(std::size_t poses, int turns) {
  PoseGraph graph;
  const double step_rad = 2.0 * std::numbers::pi * turns / static_cast<double>(poses);
  const Se2 step = Se2::from_xy_yaw(1.0, 0.0, step_rad);
  Se2 pose = Se2::from_xy_yaw(3.0, -1.0, 2.0);
  for (std::size_t i = 0; i < poses; ++i) {
    GraphVertex& vertex = graph.vertices.emplace_back();
    vertex.id = static_cast<std::int64_t>(i);
    vertex.frame_from_body = graph_pose(pose);
    pose = pose * step;
    graph.edges.push_back(
        between_edge(i, (i + 1) % poses, step, Eigen::Vector3d(4.0, 4.0, 9.0).asDiagonal()));
  }
  return graph;
}

TEST(LinearStart, IsExactForExactMeasurementsHoweverOftenTheHeadingsWrap) {
  const PoseGraph truth = exact_circles(60, 3);
  PoseGraph spoilt = truth;
  for (std::size_t i = 1; i < spoilt.vertices.size(); ++i) {
    spoilt.vertices[i].frame_from_body = {.x = 5.0, .y = 5.0, .yaw_rad = 40.0};
  }
  const std::vector<GraphPose> poses = linear_start(spoilt);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_THAT(to_se2(poses[i]), IsNear(to_se2(truth.vertices[i].frame_from_body), 1e-9));
  }
}

TEST(LinearStart, KeepsEachPartOfTheGraphWhereItsFixedVertexIs) {
  PoseGraph graph = exact_circles(12, 1);
  const std::vector<GraphPose> alone = linear_start(graph);
  GraphVertex& lonely = graph.vertices.emplace_back();
  lonely.frame_from_body = {.x = 70.0, .y = 8.0, .yaw_rad = 9.0};
  graph.vertices[5].is_fixed = true;
  graph.vertices[5].frame_from_body = {.x = 100.0, .y = 1.0, .yaw_rad = 0.5};
  const std::vector<GraphPose> poses = linear_start(graph);
  EXPECT_EQ(poses.back(), lonely.frame_from_body);
  EXPECT_EQ(poses[5], graph.vertices[5].frame_from_body);
  EXPECT_THAT(to_se2(between(poses[5], poses[9])),
              IsNear(to_se2(between(alone[5], alone[9])), 1e-9));
}

TEST(LinearStart, IsNearTheOptimumOfNoisyMeasurements) {
  Rng rng = make_rng(3);
  const PoseGraph graph = testing::simulated_graph(600, 0.5, rng).measured;
  const double optimum = optimise(graph).chi2;
  EXPECT_LT(chi2(with_poses(graph, linear_start(graph))), 3.0 * optimum);
  EXPECT_GT(chi2(graph), 100.0 * optimum);
}

TEST(LinearStart, LeavesAGraphWithoutEdgesAsItIs) {
  PoseGraph graph;
  EXPECT_TRUE(linear_start(graph).empty());
  graph.vertices.resize(2);
  graph.vertices[1].frame_from_body.x = 7.0;
  EXPECT_EQ(linear_start(graph)[1], graph.vertices[1].frame_from_body);
}

TEST(DeadReckoning, FollowsTheStepsInEitherDirection) {
  PoseGraph graph;
  graph.vertices.resize(4);
  graph.vertices[0].frame_from_body = {.x = 1.0, .y = 2.0, .yaw_rad = std::numbers::pi / 2.0};
  graph.vertices[3].frame_from_body = {.x = -7.0};
  const Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
  graph.edges.push_back(between_edge(0, 1, Se2::from_xy_yaw(2.0, 0.0, 0.0), information));
  graph.edges.push_back(between_edge(2, 1, Se2::from_xy_yaw(-3.0, 0.0, 0.0), information));
  graph.edges.push_back(between_edge(0, 2, Se2::from_xy_yaw(9.0, 0.0, 0.0), information));
  const std::vector<GraphPose> poses = dead_reckoning(graph);
  EXPECT_THAT(to_se2(poses[2]), IsNear(Se2::from_xy_yaw(1.0, 7.0, std::numbers::pi / 2.0), 1e-12));
  EXPECT_EQ(poses[3], graph.vertices[3].frame_from_body);
}

}  // namespace
}  // namespace sketchloc
