#include "topology/run_graph.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "motion/graph/optimise.hpp"
#include "tests/support/aisle_drive.hpp"

namespace sketchloc {
namespace {

HeadingEvidence evidence_of(const std::vector<Se2>& poses) {
  HeadingEvidence evidence{.travel = travel_of(poses)};
  evidence.pieces = straight_pieces(poses, evidence.travel);
  DriftTracker tracker;
  for (const StraightPiece& piece : evidence.pieces) {
    tracker.add(piece);
  }
  evidence.headings = tracker.headings();
  evidence.drift_rad = drift_at_poses(evidence.travel, evidence.pieces, evidence.headings);
  return evidence;
}

TEST(RunGraph, IsAtItsOptimumWithoutDriftAndNoise) {
  Rng rng = make_rng(1);
  const auto drive = testing::aisle_drive({.aisles = 2}, rng);
  const PoseGraph graph = run_graph(drive.odom_from_robot, evidence_of(drive.odom_from_robot), {});
  EXPECT_EQ(graph.vertices.size(), drive.odom_from_robot.size());
  EXPECT_LT(chi2(graph), 1e-2);
}

TEST(RunGraph, HoldsTheFirstHeadingWhereNothingTellsTheWalls) {
  const std::vector<Se2> poses = {Se2::from_xy_yaw(1.0, 2.0, 0.4), Se2::from_xy_yaw(1.1, 2.0, 0.4)};
  const auto result = optimise(run_graph(poses, evidence_of(poses), {}));
  EXPECT_EQ(result.status, OptimiseResult::Status::Converged);
  EXPECT_NEAR(result.poses[0].yaw_rad, 0.4, 1e-6);
  EXPECT_NEAR(result.poses[0].x, 1.0, 1e-6);
}

TEST(RunGraph, OfNothingIsEmpty) { EXPECT_TRUE(run_graph({}, {}, {}).vertices.empty()); }

TEST(TieTogether, SaysThatTwoPosesLieOnOneLine) {
  std::vector<Se2> poses;
  for (int i = 0; i < 20; ++i) {
    poses.push_back(Se2::from_xy_yaw(0.5 * i, 0.0, 0.0));
  }
  PoseGraph graph = run_graph(poses, evidence_of(poses), {});
  const std::size_t before = graph.edges.size();
  tie_together(graph, {.beside = {{0, 12, 0.3}, {1, 13, 0.1}, {2, 14, 0.2}}}, {});
  ASSERT_EQ(graph.edges.size(), before + 1);
  const GraphEdge& edge = graph.edges.back();
  EXPECT_EQ(edge.first, 2U);  // where the distance is the median
  EXPECT_EQ(edge.second, 14U);
  EXPECT_TRUE(edge.may_be_wrong);
  EXPECT_EQ(edge.information(0, 0), 0.0);  // nothing is said along the aisle
  EXPECT_GT(edge.information(1, 1), 0.0);
}

TEST(RunGraph, RefusesParametersOutOfRange) {
  EXPECT_THROW(validate(RunGraphParams{.step_sigma_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(RunGraphParams{.pass_sigma_m = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
