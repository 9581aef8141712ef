#include "tests/support/aisle_drive.hpp"

#include <cmath>
#include <numbers>

#include "motion/angles.hpp"
#include "motion/trajectory.hpp"

namespace sketchloc::testing {
namespace {

constexpr double kStep_m = 0.2;
constexpr int kStepsOfAQuarter = 6;

class Driver {
 public:
  Driver(const AisleDriveParams& params, Rng& rng) : params_(params), rng_(rng) {
    world_ = Se2::from_xy_yaw(0.0, 0.0, 0.5 * std::numbers::pi);
    odom_ =
        Se2::from_xy_yaw(0.0, 0.0, 0.5 * std::numbers::pi + rad_from_deg(params.first_heading_deg));
    keep(PlaceLabel::Corridor);
  }

  void straight(double length_m, PlaceLabel label) {
    for (int i = 0; i < std::lround(length_m / kStep_m); ++i) {
      step(Se2::from_xy_yaw(kStep_m, 0.0, 0.0), label);
    }
  }

  void turn(int quarters) {
    const double error_rad = gaussian(rad_from_deg(params_.turn_error_deg), rng_);
    for (int i = 0; i < kStepsOfAQuarter; ++i) {
      step(Se2::from_xy_yaw(0.05, 0.0, 0.5 * std::numbers::pi * quarters / kStepsOfAQuarter),
           PlaceLabel::Corridor, error_rad / kStepsOfAQuarter);
    }
  }

  void aisle() {
    straight(0.4 * params_.aisle_m, PlaceLabel::Rackspace);
    straight(0.2 * params_.aisle_m, PlaceLabel::Intersection);
    straight(0.4 * params_.aisle_m, PlaceLabel::Rackspace);
  }

  AisleDrive take() { return std::move(drive_); }

 private:
  void step(const Se2& motion, PlaceLabel label, double error_rad = 0.0) {
    world_ = world_ * motion;
    const double drift_rad =
        error_rad + rad_from_deg(params_.drift_deg_per_m) * motion.translation().norm();
    odom_ = odom_ * motion * Se2::from_xy_yaw(0.0, 0.0, drift_rad);
    keep(label);
  }

  void keep(PlaceLabel label) {
    drive_.world_from_robot.push_back(world_);
    drive_.odom_from_robot.push_back(odom_);
    drive_.labels.push_back(label);
  }

  const AisleDriveParams& params_;
  Rng& rng_;
  Se2 world_;
  Se2 odom_;
  AisleDrive drive_;
};

}  // namespace

AisleDrive aisle_drive(const AisleDriveParams& params, Rng& rng) {
  Driver driver(params, rng);
  for (int lap = 0; lap < 2; ++lap) {
    for (int aisle = 0; aisle < params.aisles; ++aisle) {
      driver.aisle();
      const bool at_the_end = aisle + 1 == params.aisles;
      const int side = (aisle % 2 == 0 ? -1 : 1) * (lap == 0 ? 1 : -1);
      if (at_the_end) {  // turns round and comes back the same way
        driver.turn(1);
        driver.turn(1);
      } else {
        driver.turn(side);
        driver.straight(params.spacing_m, PlaceLabel::Corridor);
        driver.turn(side);
      }
    }
  }
  return driver.take();
}

double mean_distance_m(const std::vector<Se2>& reference, const std::vector<Se2>& poses) {
  std::vector<Eigen::Vector2d> from;
  std::vector<Eigen::Vector2d> to;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    from.push_back(poses[i].translation());
    to.push_back(reference[i].translation());
  }
  const Se2 laid = align_se2(from, to);
  double sum = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    sum += (laid * from[i] - to[i]).norm();
  }
  return sum / static_cast<double>(from.size());
}

}  // namespace sketchloc::testing
