#include "topology/place_comparator.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>

#include "registration/shipped_networks.hpp"

namespace sketchloc {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::Pointwise;

/// Two passes along x.
NodeEndsPair passes(double across_m, double along_m) {
  return {.first = {.from_in_manhattan = {0.0, 0.0}, .to_in_manhattan = {5.0, 0.0}},
          .second = {.from_in_manhattan = {along_m, across_m},
                     .to_in_manhattan = {5.0 + along_m, across_m}}};
}

NodeEndsPair moved(NodeEndsPair pair, const Eigen::Vector2d& by) {
  for (NodeEnds* node : {&pair.first, &pair.second}) {
    node->from_in_manhattan += by;
    node->to_in_manhattan += by;
  }
  return pair;
}

TEST(ComparatorInput, IsAboutTheMiddleOfBoth) {
  const auto input = comparator_input(passes(1.0, 0.0));
  EXPECT_THAT(input[0], ElementsAre(-0.25F, -0.05F, 0.25F, -0.05F));
  EXPECT_THAT(input[1], ElementsAre(-0.25F, 0.05F, 0.25F, 0.05F));
}

TEST(ComparatorInput, DoesNotChangeWithPlaceOrDirection) {
  const NodeEndsPair pair = passes(0.4, 0.3);
  const auto input = comparator_input(pair);
  const auto elsewhere = comparator_input(moved(pair, {30.0, -12.0}));
  NodeEndsPair backwards = pair;
  std::swap(backwards.second.from_in_manhattan, backwards.second.to_in_manhattan);
  for (const std::size_t node : {0U, 1U}) {
    EXPECT_THAT(elsewhere[node], Pointwise(FloatNear(1e-6F), input[node]));
    EXPECT_EQ(comparator_input(backwards)[node], input[node]);
  }
}

TEST(PlaceComparator, PutsPassesOfOnePlaceTogetherAndOthersApart) {
  PlaceComparator comparator(shipped_place_comparator());
  const std::vector<double> distances = comparator.distances(
      std::array{passes(0.2, 0.5), passes(-0.3, -0.5), passes(2.5, 0.0), passes(-6.0, 0.5)});
  ASSERT_EQ(distances.size(), 4U);
  EXPECT_LT(distances[0], 0.5);
  EXPECT_LT(distances[1], 0.5);
  EXPECT_GT(distances[2], 0.5);
  EXPECT_GT(distances[3], 0.5);
}

TEST(PlaceComparator, ComparesNothingWithoutPairs) {
  EXPECT_TRUE(PlaceComparator(shipped_place_comparator()).distances({}).empty());
}

TEST(PlaceComparator, RefusesWhatIsNoSuchNetwork) {
  const std::array<std::uint8_t, 3> noise = {1, 2, 3};
  EXPECT_THROW(PlaceComparator{noise}, std::runtime_error);
  EXPECT_THROW(PlaceComparator{shipped_place_classifier()}, std::runtime_error);
}

}  // namespace
}  // namespace sketchloc
