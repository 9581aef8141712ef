#include "motion/graph/detail/thinned_descent.hpp"

#include <gtest/gtest.h>

#include "tests/support/graphs.hpp"

namespace sketchloc {
namespace {

using detail::Descent;
using detail::EdgeWeighting;
using detail::NormalEquations;
using detail::ThinnedDescent;

PoseGraph with_wrong_half(std::uint64_t seed) {
  Rng rng = make_rng(seed);
  PoseGraph graph = testing::simulated_graph(200, 0.5, rng).measured;
  graph = with_poses(graph, optimise(graph).poses);
  return testing::with_random_loops(graph, testing::doubted(graph), rng);
}

TEST(NormalEquations, AnEdgeThatJoinsNothingCountsInTheGradientAndOnTheDiagonal) {
  const PoseGraph graph = with_wrong_half(1);
  std::vector<bool> joins(graph.edges.size(), true);
  joins.back() = false;
  const std::vector<bool> held = detail::held_vertices(graph);
  NormalEquations all(graph, held);
  NormalEquations thinned(graph, held, nullptr, joins);
  all.linearise(detail::poses_of(graph), {});
  thinned.linearise(detail::poses_of(graph), {});
  EXPECT_EQ(thinned.values().size() + 9, all.values().size());
  for (std::size_t i = 1; i < graph.vertices.size(); ++i) {
    const auto a = all.unknowns().offset(i);
    const auto b = thinned.unknowns().offset(i);
    EXPECT_TRUE(all.gradient().segment<3>(a).isApprox(thinned.gradient().segment<3>(b), 1e-12));
    EXPECT_TRUE(all.diagonal().segment<3>(a).isApprox(thinned.diagonal().segment<3>(b), 1e-12));
  }
}

class ThinnedDescents : public ::testing::TestWithParam<KernelShape> {};
INSTANTIATE_TEST_SUITE_P(Shapes, ThinnedDescents,
                         ::testing::Values(KernelShape::Huber, KernelShape::Cauchy,
                                           KernelShape::Dcs));

TEST_P(ThinnedDescents, EndWhereTheWholeMatrixDoes) {
  const PoseGraph graph = with_wrong_half(2);
  const EdgeWeighting weighting{.kernel = {.shape = GetParam()}};
  OptimiseParams params;
  params.cost_tolerance = 1e-10;
  NormalEquations equations(graph, detail::held_vertices(graph));
  Descent whole(equations, detail::poses_of(graph), params);
  whole.run(weighting, 300);
  ThinnedDescent thinned(graph, detail::poses_of(graph), params);
  EXPECT_NE(thinned.run(weighting, 300), OptimiseResult::Status::Singular);
  // Huber's far edges fade so slowly that many just below the limit slow it down.
  const double share = GetParam() == KernelShape::Huber ? 2e-3 : 1e-4;
  EXPECT_NEAR(thinned.cost(weighting), whole.cost(), share * whole.cost());
}

TEST(ThinnedDescent, AGraphWithoutDoubtsIsMovedAsAnyOther) {
  Rng rng = make_rng(3);
  PoseGraph graph = testing::simulated_graph(200, 0.5, rng).measured;
  for (GraphEdge& edge : graph.edges) {
    edge.may_be_wrong = false;
  }
  ThinnedDescent descent(graph, detail::poses_of(graph), {});
  EXPECT_EQ(descent.run({}, 100), OptimiseResult::Status::Converged);
  EXPECT_NEAR(descent.cost({}), optimise(graph, {.initial = GraphStart::Given}).chi2, 1e-3);
}

}  // namespace
}  // namespace sketchloc
