#include "motion/graph/fixed_lag.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/support/graphs.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

GraphVertex vertex(std::size_t index, const GraphPose& pose) {
  GraphVertex result;
  result.id = static_cast<std::int64_t>(index);
  result.frame_from_body = pose;
  return result;
}

/// A robot on the x axis: headings and sideways offsets are measured as 0, so that all is linear in
/// x, whatever the measurements of x say.
PoseGraph line_graph(std::size_t poses) {
  Rng rng = make_rng(5);
  PoseGraph graph;
  const auto edge = [&](std::size_t first, std::size_t second) {
    const double way_m = static_cast<double>(second - first) + gaussian(0.3, rng);
    return between_edge(first, second, Se2::from_xy_yaw(way_m, 0.0, 0.0),
                        Eigen::Vector3d(uniform(1.0, 9.0, rng), 4.0, 100.0).asDiagonal());
  };
  for (std::size_t i = 0; i < poses; ++i) {
    graph.vertices.push_back(vertex(i, {.x = static_cast<double>(i)}));
    for (const std::size_t back : {1U, 2U, 4U}) {
      if (i >= back) {
        graph.edges.push_back(edge(i - back, i));
      }
    }
    if (i % 7 == 3) {
      graph.edges.push_back(prior_edge(i, Se2::from_xy_yaw(static_cast<double>(i) + 0.2, 0.0, 0.0),
                                       Eigen::Vector3d(0.5, 0.5, 0.5).asDiagonal()));
    }
  }
  return graph;
}

/// Edges come with their later vertex.
void feed(FixedLagSmoother& smoother, const PoseGraph& graph, std::size_t index) {
  smoother.add(graph.vertices[index]);
  for (const GraphEdge& edge : graph.edges) {
    if (std::max(edge.first, edge.second) == index) {
      smoother.add(edge);
    }
  }
  smoother.update();
}

TEST(FixedLag, IsTheBatchForLinearMeasurements) {
  const PoseGraph graph = line_graph(40);
  FixedLagSmoother smoother({.lag = 6});
  PoseGraph so_far;
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
    feed(smoother, graph, i);
    so_far.vertices.push_back(graph.vertices[i]);
    so_far.edges.clear();
    for (const GraphEdge& edge : graph.edges) {
      if (std::max(edge.first, edge.second) <= i) {
        so_far.edges.push_back(edge);
      }
    }
    const OptimiseResult batch = optimise(so_far, {.cost_tolerance = 1e-14});
    for (std::size_t j = i >= 5 ? i - 5 : 0; j <= i; ++j) {
      EXPECT_NEAR(smoother.pose(j).x, batch.poses[j].x, 1e-7) << i << " " << j;
    }
  }
  EXPECT_EQ(smoother.moving(), 6U);
}

TEST(FixedLag, FollowsARobotNearlyAsWellAsTheBatch) {
  Rng rng = make_rng(8);
  const PoseGraph graph = testing::simulated_graph(150, 0.0, rng).measured;
  PoseGraph with_priors = graph;  // now and then the robot sees where it is
  const OptimiseResult odometry = optimise(graph);
  for (std::size_t i = 10; i < 150; i += 10) {
    with_priors.edges.push_back(
        prior_edge(i, to_se2(odometry.poses[i]), Eigen::Vector3d(25.0, 25.0, 100.0).asDiagonal()));
  }
  FixedLagSmoother smoother({.lag = 20});
  for (std::size_t i = 0; i < 150; ++i) {
    feed(smoother, with_priors, i);
  }
  const OptimiseResult batch = optimise(with_priors);
  EXPECT_THAT(to_se2(smoother.pose(149)), testing::IsNear(to_se2(batch.poses[149]), 0.02));
}

TEST(FixedLag, WrapsTheHeadingsOfWhatItRemembers) {
  FixedLagSmoother smoother({.lag = 2});
  const Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
  smoother.add(vertex(0, {.yaw_rad = 3.0}));
  smoother.add(prior_edge(0, Se2::from_xy_yaw(0.0, 0.0, 3.0), information));
  GraphPose pose{.yaw_rad = 3.0};
  for (std::size_t i = 1; i < 12; ++i) {  // turns on and on; headings come wrapped
    pose = graph_pose(to_se2(compose(pose, {.yaw_rad = 1.0})));
    smoother.add(vertex(i, pose));
    smoother.add(between_edge(i - 1, i, Se2::from_xy_yaw(0.0, 0.0, 1.0), information));
    EXPECT_EQ(smoother.update(), OptimiseResult::Status::Converged);
    EXPECT_NEAR(std::remainder(smoother.pose(i).yaw_rad - 3.0 - static_cast<double>(i),
                               2.0 * std::numbers::pi),
                0.0, 1e-6);
  }
}

TEST(FixedLag, RefusesEdgesToWhatHasLeftAndKeepsWhatIsToStay) {
  FixedLagSmoother smoother({.lag = 2});
  const Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
  smoother.add(vertex(0, {}), true);
  for (std::size_t i = 1; i < 6; ++i) {
    smoother.add(vertex(i, {.x = static_cast<double>(i)}));
    smoother.add(between_edge(i - 1, i, Se2::from_xy_yaw(1.0, 0.0, 0.0), information));
    smoother.update();
  }
  EXPECT_EQ(smoother.moving(), 3U);
  EXPECT_TRUE(smoother.add(between_edge(0, 5, Se2::from_xy_yaw(5.0, 0.0, 0.0), information)));
  EXPECT_FALSE(smoother.add(between_edge(2, 5, Se2::from_xy_yaw(3.0, 0.0, 0.0), information)));
  EXPECT_NEAR(smoother.pose(2).x, 2.0, 1e-9);
}

TEST(FixedLag, RefusesTheGraduatedKernel) {
  EXPECT_THROW(FixedLagSmoother({.kernel = {.shape = KernelShape::Graduated}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
