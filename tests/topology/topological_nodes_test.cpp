#include "topology/topological_nodes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace sketchloc {
namespace {

constexpr PlaceLabel R = PlaceLabel::Rackspace;
constexpr PlaceLabel C = PlaceLabel::Corridor;
constexpr PlaceLabel I = PlaceLabel::Intersection;

Travel steps_of_a_metre(std::size_t poses) {
  Travel travel;
  for (std::size_t i = 0; i < poses; ++i) {
    travel.way_m.push_back(static_cast<double>(i));
    travel.yaw_rad.push_back(0.0);
  }
  return travel;
}

TEST(TopologicalNodes, AreRunsOfOneLabel) {
  const std::vector<PlaceLabel> labels = {R, R, R, I, I, C, R, R};
  const auto nodes = topological_nodes(steps_of_a_metre(8), labels);
  ASSERT_EQ(nodes.size(), 3U);  // a corridor of one pose is none
  EXPECT_EQ(nodes[0].first, 0U);
  EXPECT_EQ(nodes[0].last, 2U);
  EXPECT_EQ(nodes[0].length_m, 2.0);
  EXPECT_EQ(nodes[1].label, I);
  EXPECT_EQ(nodes[2].first, 6U);
}

TEST(TopologicalNodes, EndAtATurn) {
  Travel travel = steps_of_a_metre(6);
  for (std::size_t i = 3; i < 6; ++i) {
    travel.yaw_rad[i] = 1.5;
  }
  EXPECT_EQ(topological_nodes(travel, std::vector<PlaceLabel>(6, C)).size(), 2U);
}

TEST(TopologicalNodes, OfNothingAreNone) { EXPECT_TRUE(topological_nodes({}, {}).empty()); }

TEST(TopologicalNodes, RefuseParametersOutOfRange) {
  EXPECT_THROW(validate(NodeParams{.shortest_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(NodeParams{.most_turn_deg = 5.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
