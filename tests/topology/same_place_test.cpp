#include "topology/same_place.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

namespace sketchloc {
namespace {

constexpr PlaceLabel R = PlaceLabel::Rackspace;
constexpr PlaceLabel C = PlaceLabel::Corridor;

/// Two straight passes of ten poses each, half a metre apart along y.
struct Passes {
  std::vector<Se2> poses;
  std::vector<TopologicalNode> nodes;
};

Passes passes(double across_m, double along_m, PlaceLabel second = R, double turned_rad = 0.0) {
  Passes result;
  for (int i = 0; i < 10; ++i) {
    result.poses.push_back(Se2::from_xy_yaw(0.0, 0.5 * i, 0.5 * std::numbers::pi));
  }
  const Se2 moved = Se2::from_xy_yaw(across_m, along_m, turned_rad);
  for (int i = 0; i < 10; ++i) {
    result.poses.push_back(moved * result.poses[static_cast<std::size_t>(9 - i)]);
  }
  result.nodes = {{.first = 0, .last = 9, .label = R, .length_m = 4.5},
                  {.first = 10, .last = 19, .label = second, .length_m = 4.5}};
  return result;
}

std::vector<SamePlacePair> pairs_of(const Passes& passes, double least = 0.4) {
  return same_places(passes.poses, travel_of(passes.poses), passes.nodes, {}, least);
}

TEST(SamePlaces, AreTwoPassesOfOneAisle) {
  const auto pairs = pairs_of(passes(0.3, 0.4));
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].earlier, 0U);
  EXPECT_EQ(pairs[0].later, 1U);
  EXPECT_NEAR(pairs[0].across_m, 0.3, 1e-9);
  EXPECT_GT(pairs[0].probability, 0.7);
  ASSERT_FALSE(pairs[0].beside.empty());
  for (const PosesBeside& poses : pairs[0].beside) {
    EXPECT_LT(poses.earlier, 10U);
    EXPECT_GE(poses.later, 10U);
    EXPECT_NEAR(poses.across_m, 0.3, 1e-9);
  }
}

TEST(SamePlaces, AreLessLikelyTheFartherApart) {
  EXPECT_GT(pairs_of(passes(0.0, 0.0))[0].probability, pairs_of(passes(0.5, 0.0))[0].probability);
  EXPECT_TRUE(pairs_of(passes(2.5, 0.0)).empty());
}

TEST(SamePlaces, HaveOneLabelOneAxisAndAStretchInCommon) {
  EXPECT_TRUE(pairs_of(passes(0.0, 0.0, C)).empty());
  EXPECT_TRUE(pairs_of(passes(0.0, 0.0, R, 0.5 * std::numbers::pi)).empty());
  EXPECT_TRUE(pairs_of(passes(0.0, 0.0, R, 0.6)).empty());  // along no wall
  EXPECT_TRUE(pairs_of(passes(0.0, 3.5)).empty());
}

TEST(SamePlaces, RefuseParametersOutOfRange) {
  EXPECT_THROW(validate(SamePlaceParams{.overlap_share = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(SamePlaceParams{.pass_sigma_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(SamePlaceParams{.confident = 1.5}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
