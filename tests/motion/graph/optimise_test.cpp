#include "motion/graph/optimise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "motion/graph/linear_start.hpp"
#include "tests/support/ceres_graph.hpp"
#include "tests/support/graphs.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::IsNear;
using Status = OptimiseResult::Status;

PoseGraph simulated(std::uint64_t seed, std::size_t poses = 300) {
  Rng rng = make_rng(seed);
  return testing::simulated_graph(poses, 0.5, rng).measured;
}

TEST(Optimise, ReachesTheOptimumThatCeresFinds) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const PoseGraph graph = simulated(seed);
    const testing::CeresAnswer answer =
        testing::ceres_optimum(with_poses(graph, linear_start(graph)), 1e-12);
    for (const GraphStart initial : {GraphStart::Given, GraphStart::Linear, GraphStart::Better}) {
      const OptimiseResult result = optimise(graph, {.initial = initial, .cost_tolerance = 1e-12});
      EXPECT_EQ(result.status, Status::Converged);
      EXPECT_NEAR(result.chi2, answer.chi2, 1e-6 * answer.chi2);
      for (std::size_t i = 0; i < answer.poses.size(); ++i) {
        EXPECT_THAT(to_se2(result.poses[i]), IsNear(to_se2(answer.poses[i]), 1e-3));
      }
    }
  }
}

TEST(Optimise, SaysWhatItCostBeforeAndAfter) {
  const PoseGraph graph = simulated(4);
  const OptimiseResult result = optimise(graph);
  EXPECT_DOUBLE_EQ(result.start_chi2, chi2(graph));
  EXPECT_NEAR(result.chi2, chi2(with_poses(graph, result.poses)), 1e-9 * result.chi2);
  EXPECT_DOUBLE_EQ(result.cost, result.chi2);
  EXPECT_EQ(result.weights, std::vector<double>(graph.edges.size(), 1.0));
}

TEST(Optimise, CostsAreSumsOfSquaresWithoutAHalf) {
  PoseGraph graph;
  graph.vertices.resize(2);
  graph.vertices[1].frame_from_body = {.x = 1.0, .y = 0.0, .yaw_rad = 0.2};
  graph.edges.push_back(between_edge(0, 1, Se2::from_xy_yaw(3.0, 0.0, 0.0),
                                     Eigen::Vector3d(10.0, 1.0, 100.0).asDiagonal()));
  EXPECT_DOUBLE_EQ(chi2(graph), 10.0 * 4.0 + 100.0 * 0.04);
}

TEST(Optimise, KeepsFixedVerticesAndElseTheFirstOfEachPart) {
  PoseGraph graph = simulated(5, 80);
  graph.vertices.front().is_fixed = false;
  graph.vertices[40].is_fixed = true;
  const OptimiseResult result = optimise(graph);
  EXPECT_EQ(result.poses[40], graph.vertices[40].frame_from_body);
  EXPECT_NE(result.poses[0], graph.vertices[0].frame_from_body);
  graph.vertices[40].is_fixed = false;
  EXPECT_EQ(optimise(graph).poses[0], graph.vertices[0].frame_from_body);
}

TEST(Optimise, ThePoseOfTheWholeGraphDoesNotMatter) {
  PoseGraph graph = simulated(6, 120);
  const double before = optimise(graph).chi2;
  const GraphPose elsewhere{.x = -300.0, .y = 80.0, .yaw_rad = 2.5};
  for (GraphVertex& vertex : graph.vertices) {
    vertex.frame_from_body = compose(elsewhere, vertex.frame_from_body);
  }
  EXPECT_NEAR(optimise(graph).chi2, before, 1e-6 * before);
}

TEST(Optimise, PriorsHoldAGraphWithoutAFixedVertex) {
  PoseGraph graph;
  graph.vertices.resize(2);
  graph.edges.push_back(
      prior_edge(0, Se2::from_xy_yaw(5.0, 1.0, 3.0), Eigen::Matrix3d::Identity()));
  graph.edges.push_back(
      between_edge(0, 1, Se2::from_xy_yaw(1.0, 0.0, 0.5), Eigen::Matrix3d::Identity()));
  const OptimiseResult result = optimise(graph);
  EXPECT_EQ(result.status, Status::Converged);
  EXPECT_THAT(to_se2(result.poses[1]),
              IsNear(Se2::from_xy_yaw(5.0, 1.0, 3.0) * Se2::from_xy_yaw(1.0, 0.0, 0.5), 1e-6));
}

TEST(Optimise, OfTwoMeasurementsItTakesTheMeanByInformation) {
  PoseGraph graph;
  graph.vertices.resize(2);
  const auto x = [](double x_m, double information) {
    return between_edge(0, 1, Se2::from_xy_yaw(x_m, 0.0, 0.0),
                        Eigen::Vector3d(information, 1.0, 1.0).asDiagonal());
  };
  graph.edges = {x(1.0, 3.0), x(2.0, 1.0)};
  const OptimiseResult result = optimise(graph);
  EXPECT_NEAR(result.poses[1].x, 1.25, 1e-9);
  EXPECT_NEAR(result.chi2, 3.0 * 0.0625 + 0.5625, 1e-9);
}

/// A chain of similarities whose local scale is registered at both ends.
TEST(Optimise, EstimatesPositionHeadingAndScaleOfSimilarities) {
  PoseGraph graph;
  constexpr std::size_t kPoses = 11;
  const Eigen::Matrix4d loose = Eigen::Vector4d(1e4, 1e4, 1e4, 100.0).asDiagonal();
  const Eigen::Matrix4d tight = Eigen::Vector4d(1e6, 1e6, 1e6, 1e6).asDiagonal();
  const double change = std::log(2.0) / 10.0;
  Sim2 pose = Sim2::from_xy_yaw_scale(50.0, 60.0, 1.0, 10.0);
  const Sim2 step = Sim2::from_xy_yaw_scale(1.0, 0.0, 0.05, std::exp(change));
  std::vector<Sim2> truth;
  for (std::size_t i = 0; i < kPoses; ++i) {
    truth.push_back(pose);
    GraphVertex& vertex = graph.vertices.emplace_back();
    vertex.kind = VertexKind::Sim2;
    vertex.frame_from_body = graph_pose(truth.front());
    if (i > 0) {  // says that the scale stays, but not very surely
      graph.edges.push_back(
          between_edge(i - 1, i, Sim2::from_xy_yaw_scale(1.0, 0.0, 0.05, 1.0), loose));
    }
    pose = pose * step;
  }
  graph.edges.push_back(prior_edge(0, truth.front(), tight));
  graph.edges.push_back(prior_edge(kPoses - 1, truth.back(), tight));
  const OptimiseResult result = optimise(graph, {.cost_tolerance = 1e-12});
  EXPECT_EQ(result.status, Status::Converged);
  for (std::size_t i = 0; i < kPoses; ++i) {  // the change of scale is shared out evenly
    EXPECT_NEAR(result.poses[i].log_scale, std::log(10.0) + change * static_cast<double>(i), 1e-3);
  }
}

TEST(Optimise, FindsHowAMetricFrameLiesInADrawing) {
  Rng rng = make_rng(9);
  testing::SimulatedGraph simulated = testing::simulated_graph(60, 0.5, rng);
  PoseGraph graph = simulated.truth;
  graph.edges = simulated.measured.edges;
  graph.vertices.front().is_fixed = true;
  const Sim2 sketch_from_world = Sim2::from_xy_yaw_scale(300.0, 200.0, -1.2, 17.0);
  const std::size_t frame = graph.vertices.size();
  GraphVertex& sketch = graph.vertices.emplace_back();
  sketch.kind = VertexKind::Sim2;
  sketch.frame_from_body = graph_pose(Sim2::from_xy_yaw_scale(250.0, 250.0, -0.5, 12.0));
  const Eigen::Matrix4d information = Eigen::Vector4d(1e4, 1e4, 1e4, 1e2).asDiagonal();
  for (std::size_t i = 0; i < 60; i += 5) {
    graph.edges.push_back(registration_edge(
        frame, i, sketch_from_world * to_se2(graph.vertices[i].frame_from_body), information));
  }
  const OptimiseResult result = optimise(graph);
  EXPECT_EQ(result.status, Status::Converged);
  EXPECT_NEAR(std::exp(result.poses[frame].log_scale), 17.0, 0.5);
  EXPECT_NEAR(result.poses[frame].x, 300.0, 5.0);
  EXPECT_NEAR(std::remainder(result.poses[frame].yaw_rad + 1.2, 2.0 * std::numbers::pi), 0.0, 0.01);
}

TEST(Optimise, ManhattanEdgesStraightenADriftingAisle) {
  PoseGraph graph;
  const Eigen::Matrix3d information = Eigen::Vector3d(400.0, 400.0, 1000.0).asDiagonal();
  for (std::size_t i = 0; i < 40; ++i) {
    graph.vertices.emplace_back().id = static_cast<std::int64_t>(i);
    if (i > 0) {  // the odometry drifts to the left
      graph.edges.push_back(between_edge(i - 1, i, Se2::from_xy_yaw(1.0, 0.0, 0.01), information));
    }
  }
  graph = with_poses(graph, dead_reckoning(graph));
  EXPECT_GT(graph.vertices.back().frame_from_body.y, 5.0);
  graph.edges.push_back(manhattan_edge(0, 39, ManhattanAxis::Forward, 0.01, 0.001));
  const OptimiseResult result = optimise(graph);
  EXPECT_NEAR(result.poses.back().y, 0.0, 0.1);
  EXPECT_NEAR(result.poses.back().yaw_rad, 0.0, 0.01);
}

TEST(Optimise, LongLoopsThatWrapDoNotGetStuck) {
  Rng rng = make_rng(11);
  PoseGraph graph;
  const std::size_t poses = 400;
  const double turn_rad = 2.0 * std::numbers::pi / 400.0;
  const Eigen::Matrix3d information = Eigen::Vector3d(400.0, 400.0, 1000.0).asDiagonal();
  for (std::size_t i = 0; i < poses; ++i) {
    graph.vertices.emplace_back().id = static_cast<std::int64_t>(i);
    const Se2 step = Se2::from_xy_yaw(0.5, 0.0, turn_rad + gaussian(0.03, rng) + 0.006);
    graph.edges.push_back(between_edge(i, (i + 1) % poses, step, information));
  }
  graph = with_poses(graph, dead_reckoning(graph));
  const OptimiseResult result = optimise(graph);
  EXPECT_EQ(result.status, Status::Converged);
  // The misfit of the heading, shared by all steps, is most of what is left.
  EXPECT_LT(result.chi2, 2.0 * 1000.0 * std::pow(400.0 * 0.006 + 1.2, 2) / 400.0);
}

class WrongLoops : public ::testing::TestWithParam<KernelShape> {};
INSTANTIATE_TEST_SUITE_P(Shapes, WrongLoops,
                         ::testing::Values(KernelShape::Dcs, KernelShape::Graduated));

TEST_P(WrongLoops, HalfOfAllAreLeftOutFromAnyPoses) {
  for (const std::uint64_t seed : {12U, 13U, 14U}) {
    Rng rng = make_rng(seed);
    const PoseGraph clean = testing::simulated_graph(300, 0.5, rng).measured;
    const std::size_t right = clean.edges.size();
    const PoseGraph graph = testing::with_random_loops(clean, testing::doubted(clean), rng);
    const std::vector<GraphPose> optimum = optimise(clean).poses;
    for (const PoseGraph& begun : {graph, with_poses(graph, optimum)}) {
      const OptimiseResult robust = optimise(begun, {.kernel = {.shape = GetParam()}});
      std::size_t left_out = 0;  // of the right ones: 1 % are farther off than the width
      std::size_t kept = 0;      // of the wrong ones: some are nearly right
      for (std::size_t i = 0; i < graph.edges.size(); ++i) {
        left_out += i < right && robust.weights[i] < 0.5 ? 1U : 0U;
        kept += i >= right && robust.weights[i] >= 0.5 ? 1U : 0U;
      }
      EXPECT_LT(left_out, right / 30);
      EXPECT_LT(kept, (graph.edges.size() - right) / 20);
      EXPECT_LT(testing::worst_distance_m(robust.poses, optimum), 0.5);
    }
  }
}

TEST(Optimise, OfTheGraduatedKernelNoEdgeIsOnTheWrongSideInTheEnd) {
  Rng rng = make_rng(15);
  PoseGraph graph = testing::simulated_graph(300, 0.5, rng).measured;
  graph = testing::with_random_loops(graph, testing::doubted(graph), rng);
  const RobustKernel kernel{.shape = KernelShape::Graduated, .width = 2.0};
  const OptimiseResult result = optimise(graph, {.kernel = kernel});
  EXPECT_EQ(result.status, Status::Converged);
  const std::vector<double> chi2s = chi2_of_edges(with_poses(graph, result.poses));
  for (std::size_t i = 0; i < chi2s.size(); ++i) {
    const bool is_kept = !graph.edges[i].may_be_wrong || chi2s[i] <= 4.0;
    EXPECT_EQ(result.weights[i], is_kept ? 1.0 : 0.0);
  }
}

TEST(Optimise, AKernelWithoutDoubtsChangesNothing) {
  PoseGraph graph = simulated(16);
  for (GraphEdge& edge : graph.edges) {
    edge.may_be_wrong = false;
  }
  EXPECT_EQ(optimise(graph, {.kernel = {.shape = KernelShape::Graduated}}).poses,
            optimise(graph).poses);
}

TEST(Optimise, AnEmptyGraphAndOneThatIsAllFixedAreDone) {
  EXPECT_EQ(optimise({}).status, Status::Converged);
  PoseGraph graph;
  graph.vertices.resize(1);
  EXPECT_EQ(optimise(graph).status, Status::Converged);
}

TEST(Optimise, SaysThatItStoppedEarly) {
  const OptimiseResult result =
      optimise(simulated(7), {.initial = GraphStart::Given, .most_iterations = 1});
  EXPECT_EQ(result.status, Status::IterationLimit);
  EXPECT_LT(result.chi2, result.start_chi2);
}

TEST(Optimise, EdgesThatDetermineNothingLeaveThePosesWhereTheyAre) {
  PoseGraph graph;
  graph.vertices.resize(2);
  graph.vertices[1].frame_from_body = {.x = 3.0, .y = 4.0};
  graph.edges.push_back(between_edge(0, 1, Se2(), Eigen::Vector3d(0.0, 1.0, 1.0).asDiagonal()));
  const OptimiseResult result = optimise(graph);
  EXPECT_NE(result.status, Status::IterationLimit);
  EXPECT_NEAR(result.poses[1].y, 0.0, 1e-6);
}

TEST(Optimise, RefusesGraphsAndParametersThatMakeNoSense) {
  PoseGraph graph;
  graph.vertices.resize(2);
  graph.edges.push_back(between_edge(0, 2, Se2(), Eigen::Matrix3d::Identity()));
  EXPECT_THROW(optimise(graph), std::invalid_argument);
  graph.edges[0].second = 1;
  graph.edges[0].information(0, 1) = 5.0;
  EXPECT_THROW(optimise(graph), std::invalid_argument);
  EXPECT_THROW(optimise({}, {.most_iterations = 0}), std::invalid_argument);
  EXPECT_THROW(optimise({}, {.graduation = 1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
