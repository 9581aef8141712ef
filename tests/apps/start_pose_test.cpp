#include "apps/start_pose.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <stdexcept>

namespace sketchloc {
namespace {

TEST(StartPose, IsPlaceHeadingAndMaybeScale) {
  const StartPose start = parse_start_pose("120.5,-3,90");
  EXPECT_EQ(start.place_in_sketch, Eigen::Vector2d(120.5, -3.0));
  EXPECT_DOUBLE_EQ(start.heading_rad, std::numbers::pi / 2.0);
  EXPECT_FALSE(start.px_per_m.has_value());
  EXPECT_DOUBLE_EQ(parse_start_pose("1,2,-180,20.5").px_per_m.value(), 20.5);
}

TEST(StartPose, RejectsEverythingElse) {
  for (const char* text : {"", "1,2", "1,2,3,4,5", "1,2,x", "1,2,", "1,,3", "1,2,nan", "1,2,3,0",
                           "1,2,3,-4", "1 ,2,3", "1;2;3"}) {
    EXPECT_THROW(parse_start_pose(text), std::invalid_argument) << text;
  }
}

TEST(StartPose, NamesTheFlagThatItCameFrom) {
  try {
    parse_start_pose("1,2", "--prior");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("--prior must be")) << error.what();
  }
}

}  // namespace
}  // namespace sketchloc
