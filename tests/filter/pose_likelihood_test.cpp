#include "filter/pose_likelihood.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "filter/particle_set.hpp"
#include "registration/control_grid.hpp"

namespace sketchloc {
namespace {

/// A registration whose warp is linear.
Registration linear_registration(const Eigen::Matrix2d& sketch_from_robot) {
  const std::vector<Eigen::Vector2d> points =
      square_lattice(kControlsPerSide, 10.0, Eigen::Vector2d::Zero());
  std::vector<Eigen::Vector2d> places;
  for (const Eigen::Vector2d& point : points) {
    places.push_back(Eigen::Vector2d(100.0, 50.0) + sketch_from_robot * point);
  }
  Warp warp = *Warp::from_robot_points(points, places);
  const Sim2 pose = *warp.pose();
  return {.warp = std::move(warp),
          .sketch_from_robot = pose,
          .covariance = Eigen::Matrix4d(0.04 * Eigen::Matrix4d::Identity()),
          .inlier_probability = 0.8};
}

Eigen::Matrix2d turned(double yaw_rad) {
  return Se2::from_xy_yaw(0.0, 0.0, yaw_rad).rotation_matrix();
}

TEST(PoseLikelihood, HasTheParametersOfParticlesThatAreLikeTheWarp) {
  const Eigen::Matrix2d linear = 20.0 * strain_matrix(0.3, -0.2) * turned(0.7);
  const PoseLikelihood said = pose_likelihood(linear_registration(linear), {}, 1.0);
  EXPECT_NEAR(said.mean[0], 100.0, 1e-6);
  EXPECT_NEAR(said.mean[1], 50.0, 1e-6);
  EXPECT_NEAR(said.mean[2], 0.7, 1e-6);
  EXPECT_NEAR(said.mean[3], std::log(20.0), 1e-6);
  EXPECT_NEAR(said.strain.x(), 0.3, 1e-6);
  EXPECT_NEAR(said.strain.y(), -0.2, 1e-6);
  EXPECT_NEAR(said.outlier, 0.2, 1e-12);
}

TEST(PoseLikelihood, TakesTheCovarianceIntoTheDrawing) {
  PoseTrust exact;
  exact.min_position_m = exact.min_heading_rad = exact.min_log_scale = 1e-9;
  Registration registration = linear_registration(20.0 * turned(std::acos(-1.0) / 2.0));
  registration.covariance->diagonal() << 0.01, 0.04, 0.09, 0.16;
  const PoseLikelihood said = pose_likelihood(registration, exact, 1.0);
  EXPECT_NEAR(said.covariance(0, 0), 400.0 * 0.04, 1e-6);  // the robot's left is sketch -x
  EXPECT_NEAR(said.covariance(1, 1), 400.0 * 0.01, 1e-6);
  EXPECT_NEAR(said.covariance(2, 2), 0.09, 1e-9);
  EXPECT_NEAR(said.covariance(3, 3), 0.16, 1e-9);
}

TEST(PoseLikelihood, SaysLessWhereItsScansAreOld) {
  const Registration registration = linear_registration(20.0 * turned(0.0));
  const PoseTrust trust;
  const PoseLikelihood whole = pose_likelihood(registration, trust, 1.0);
  const PoseLikelihood part = pose_likelihood(registration, trust, 0.25);
  EXPECT_NEAR(part.covariance(0, 0), 4.0 * whole.covariance(0, 0), 1e-6);
  EXPECT_NEAR(part.strain_sigma, 2.0 * whole.strain_sigma, 1e-9);
  EXPECT_NEAR(part.outlier, whole.outlier, 1e-12);  // as probably wrong as ever
  EXPECT_LT(part.inlier, whole.inlier);
}

TEST(PoseLikelihood, WeighsARightRegistrationByTheRoomOfAWrongOne) {
  // A standard deviation of 0.2 in all four: its own room is (2 pi)^2 0.2^4.
  PoseTrust trust;
  trust.min_position_m = trust.min_heading_rad = trust.min_log_scale = 1e-9;
  trust.max_peak = 1e9;
  const Registration registration = linear_registration(20.0 * turned(0.3));
  const double own = std::pow(2.0 * std::acos(-1.0), 2) * std::pow(0.2, 4);
  const double room = std::acos(-1.0) * 9.0 * 1.6 * 1.0;
  EXPECT_NEAR(pose_likelihood(registration, trust, 1.0).inlier, 0.8 * room / own, 1e-6);
  trust.max_peak = 50.0;
  EXPECT_NEAR(pose_likelihood(registration, trust, 1.0).inlier, 0.8 * 50.0, 1e-9);
  Registration vague = registration;
  vague.covariance = Eigen::Matrix4d(100.0 * Eigen::Matrix4d::Identity());
  EXPECT_NEAR(pose_likelihood(vague, trust, 1.0).inlier, 0.8, 1e-9);  // it says nothing
}

TEST(PoseTrust, RefusesWhatIsOutOfRange) {
  EXPECT_NO_THROW(validate(PoseTrust{}));
  EXPECT_THROW(validate(PoseTrust{.max_peak = 0.5}), std::invalid_argument);
  EXPECT_THROW(validate(PoseTrust{.reach_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(PoseTrust{.max_probability = 1.0}), std::invalid_argument);
  EXPECT_THROW(validate(PoseTrust{.strain_sigma = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
