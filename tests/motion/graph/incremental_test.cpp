#include "motion/graph/incremental.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "motion/graph/detail/neighbourhood.hpp"
#include "tests/support/graphs.hpp"

namespace sketchloc {
namespace {

using Update = IncrementalSmoother::Update;

TEST(Incremental, StaysNearTheBatchAndEndsAtIt) {
  Rng rng = make_rng(2);
  const PoseGraph graph = testing::simulated_graph(400, 0.4, rng).measured;
  IncrementalSmoother smoother;
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
    smoother.add(graph.vertices[i]);
    for (const GraphEdge& edge : graph.edges) {
      if (std::max(edge.first, edge.second) == i) {
        smoother.add(edge);
      }
    }
    smoother.update();
    if (i % 50 == 49) {
      const double optimum = optimise(smoother.graph()).chi2;
      EXPECT_LT(chi2(smoother.graph()), 1.2 * optimum + 10.0) << i;
    }
  }
  EXPECT_EQ(smoother.finish(), OptimiseResult::Status::Converged);
  const double optimum = optimise(graph).chi2;
  EXPECT_NEAR(chi2(smoother.graph()), optimum, 1e-4 * optimum);
}

TEST(Incremental, DoesNothingForOdometryAlone) {
  IncrementalSmoother smoother;
  smoother.add(GraphVertex{});
  for (std::size_t i = 1; i < 10; ++i) {
    smoother.add(GraphVertex{});
    smoother.add(
        between_edge(i - 1, i, Se2::from_xy_yaw(1.0, 0.0, 0.5), Eigen::Matrix3d::Identity()));
    EXPECT_EQ(smoother.update(), Update::Nothing);
  }
  EXPECT_LT(chi2(smoother.graph()), 1e-12);
}

TEST(Incremental, PlacesAVertexFromEitherEnd) {
  IncrementalSmoother smoother;
  smoother.add(GraphVertex{});
  smoother.add(GraphVertex{});
  smoother.add(between_edge(1, 0, Se2::from_xy_yaw(1.0, 0.0, 0.5), Eigen::Matrix3d::Identity()));
  EXPECT_LT(chi2(smoother.graph()), 1e-12);
}

TEST(Neighbourhood, IsTheNearestVerticesWithAllTheirEdgesAndAFixedRim) {
  detail::LinkedGraph linked;
  for (std::size_t i = 0; i < 10; ++i) {
    linked.add(GraphVertex{});
    if (i > 0) {
      linked.add(between_edge(i - 1, i, Se2(), Eigen::Matrix3d::Identity()));
    }
  }
  linked.add(between_edge(3, 5, Se2(), Eigen::Matrix3d::Identity()));
  const std::vector<std::size_t> seeds = {4};
  const detail::LinkedGraph::Part part = linked.around(seeds, 3);
  EXPECT_EQ(part.vertices, (std::vector<std::size_t>{4, 3, 5, 2, 6}));
  EXPECT_EQ(part.moving, 3U);
  EXPECT_EQ(part.graph.edges.size(), 5U);  // 3-4, 4-5, 2-3, 3-5, 5-6
  EXPECT_FALSE(part.graph.vertices[2].is_fixed);
  EXPECT_TRUE(part.graph.vertices[3].is_fixed);
}

TEST(Incremental, RefusesTheGraduatedKernel) {
  EXPECT_THROW(IncrementalSmoother({.kernel = {.shape = KernelShape::Graduated}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
