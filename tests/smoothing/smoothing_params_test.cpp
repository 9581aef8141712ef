#include "smoothing/smoothing_params.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace sketchloc {
namespace {

TEST(SmoothingParams, AreValidByDefault) { EXPECT_NO_THROW(validate(SmoothingParams{})); }

TEST(SmoothingParams, NameTheFieldThatIsOutOfRange) {
  SmoothingParams params;
  params.walk.shear_m = 0.0;
  try {
    validate(params);
    FAIL() << "a drawing without any shear was accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("walk.shear_m"));
  }
}

TEST(WalkCovariance, GrowsWithTheWayAndTheTurn) {
  const DrawingWalk walk;
  const Eigen::Matrix4d one = walk_covariance(walk, 1.0, 0.0);
  const Eigen::Matrix4d four = walk_covariance(walk, 4.0, 0.0);
  EXPECT_NEAR(four(0, 0) - one(0, 0), 3.0 * walk.length_m * walk.length_m, 1e-12);
  EXPECT_GT(walk_covariance(walk, 1.0, 1.0)(2, 2), one(2, 2));
  EXPECT_GT(walk_covariance(walk, 0.0, 0.0).diagonal().minCoeff(), 0.0);  // never singular
}

}  // namespace
}  // namespace sketchloc
