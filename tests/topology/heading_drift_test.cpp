#include "topology/heading_drift.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "motion/angles.hpp"
#include "motion/random.hpp"

namespace sketchloc {
namespace {

using ::testing::Each;
using ::testing::ElementsAre;

constexpr double kQuarter_rad = 0.5 * std::numbers::pi;

/// Pieces 3 m apart that turn by these quarter turns, under a drift that grows steadily.
std::vector<StraightPiece> drifting(const std::vector<int>& turns, double slope_deg_per_m,
                                    double noise_deg = 0.0, std::uint64_t seed = 1) {
  Rng rng = make_rng(seed);
  std::vector<StraightPiece> pieces;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const double way_m = 3.0 * static_cast<double>(i) + 1.5;
    pieces.push_back({.first = 10 * i,
                      .last = 10 * i + 9,
                      .way_m = way_m,
                      .length_m = 3.0,
                      .axis_rad = angle_rad(turns[i]) + rad_from_deg(slope_deg_per_m * way_m) +
                                  gaussian(rad_from_deg(noise_deg), rng)});
  }
  return pieces;
}

std::vector<int> decided(const std::vector<StraightPiece>& pieces, const DriftParams& params = {}) {
  DriftTracker tracker(params);
  for (const StraightPiece& piece : pieces) {
    tracker.add(piece);
  }
  std::vector<int> turns;
  for (const PieceHeading& heading : tracker.headings()) {
    turns.push_back(heading.quarter_turns);
  }
  return turns;
}

std::vector<int> serpentine(int aisles) {
  std::vector<int> turns;
  for (int i = 0; i < aisles; ++i) {
    for (int k = 0; k < 5; ++k) {
      turns.push_back(i % 2 == 0 ? 1 : -1);
    }
    turns.push_back(0);
  }
  return turns;
}

TEST(DriftTracker, DecidesTurnsUnderADriftThatGoesRoundAndRound) {
  const std::vector<int> turns = serpentine(20);
  const auto pieces = drifting(turns, 1.2);  // 432 deg in all
  EXPECT_EQ(decided(pieces), turns);
  EXPECT_NE(nearest_quarter_turns(pieces.back().axis_rad), turns.back());
}

TEST(DriftTrackerStatistical, DecidesRightUnderNoiseInNearlyAllRuns) {
  const std::vector<int> turns = serpentine(20);
  int right = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    right += decided(drifting(turns, -0.8, 4.0, seed)) == turns ? 1 : 0;
  }
  EXPECT_GE(right, 48);
}

TEST(DriftTracker, TakesASlantedWayForOneAndKeepsTheDrift) {
  std::vector<int> turns = serpentine(4);
  auto pieces = drifting(turns, 0.5);
  pieces[8].axis_rad += rad_from_deg(38.0);
  DriftTracker tracker;
  for (const StraightPiece& piece : pieces) {
    tracker.add(piece);
  }
  const auto headings = tracker.headings();
  EXPECT_LT(headings[8].on_axis, 0.1);
  EXPECT_GT(headings[9].on_axis, 0.9);
  EXPECT_NEAR(headings[8].drift_rad, rad_from_deg(0.5 * pieces[8].way_m), rad_from_deg(2.0));
  EXPECT_EQ(headings[9].quarter_turns, turns[9]);
}

TEST(DriftTracker, SmoothsTheDriftOfAllPiecesByThoseBehindThem) {
  const auto pieces = drifting(serpentine(10), 1.0, 3.0);
  DriftTracker tracker;
  double worst_deg = 0.0;
  for (const StraightPiece& piece : pieces) {
    tracker.add(piece);
  }
  const auto headings = tracker.headings();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    worst_deg =
        std::max(worst_deg, std::abs(deg_from_rad(headings[i].drift_rad) - 1.0 * pieces[i].way_m));
  }
  EXPECT_LT(worst_deg, 6.0);
}

TEST(DriftTracker, IsUnsureWhereATurnIsHalfAQuarter) {
  DriftTracker sure;
  DriftTracker unsure;
  for (const int turn : {0, 0, 1}) {
    for (DriftTracker* tracker : {&sure, &unsure}) {
      const double way_m = 3.0 * static_cast<double>(tracker->pieces()) + 1.5;
      const double turned_rad = turn * (tracker == &sure ? kQuarter_rad : 0.5 * kQuarter_rad);
      tracker->add({.way_m = way_m, .length_m = 3.0, .axis_rad = turned_rad});
    }
  }
  EXPECT_GT(sure.log_odds(), 3.0);
  EXPECT_LT(unsure.log_odds(), 0.5);
}

TEST(DriftTracker, OfNothingSaysNothing) {
  EXPECT_TRUE(DriftTracker().headings().empty());
  EXPECT_EQ(DriftTracker().log_odds(), std::numeric_limits<double>::infinity());
}

TEST(DriftTracker, RefusesParametersOutOfRange) {
  EXPECT_THROW(DriftTracker({.wander_deg = 0.0}), std::invalid_argument);
  EXPECT_THROW(DriftTracker({.axis_sigma_deg = 5.0, .skew_sigma_deg = 5.0}), std::invalid_argument);
  EXPECT_THROW(DriftTracker({.skew_share = 1.0}), std::invalid_argument);
  EXPECT_THROW(DriftTracker({.hypotheses = 0}), std::invalid_argument);
}

TEST(DriftAtPoses, IsLinearBetweenPiecesAndSteadyBeyond) {
  const Travel travel{.way_m = {0.0, 1.0, 2.0, 3.0, 4.0}, .yaw_rad = std::vector<double>(5)};
  const std::vector<StraightPiece> pieces = {{.way_m = 1.0, .axis_rad = 0.1},
                                             {.way_m = 3.0, .axis_rad = kQuarter_rad + 0.4}};
  const std::vector<PieceHeading> headings = {{.quarter_turns = 0, .drift_rad = 0.2},
                                              {.quarter_turns = 1, .drift_rad = 0.4}};
  EXPECT_THAT(drift_at_poses(travel, pieces, headings),
              ::testing::Pointwise(::testing::DoubleNear(1e-12), {0.2, 0.2, 0.3, 0.4, 0.4}));
  EXPECT_THAT(snapped_drift_at_poses(travel, pieces, headings),
              ::testing::Pointwise(::testing::DoubleNear(1e-12), {0.1, 0.1, 0.25, 0.4, 0.4}));
  EXPECT_THAT(drift_at_poses(travel, {}, {}), Each(0.0));
}

}  // namespace
}  // namespace sketchloc
