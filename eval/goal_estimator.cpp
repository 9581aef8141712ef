#include "eval/goal_estimator.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <vector>

#include "eval/summary.hpp"
#include "motion/check.hpp"
#include "registration/warp_predictor.hpp"

namespace sketchloc {
namespace {

constexpr int kSteps = 6;  ///< after which the weights have settled

}  // namespace

GoalEstimator::GoalEstimator(int most_looks) : most_looks_(static_cast<std::size_t>(most_looks)) {
  check(most_looks >= 1, "a goal is known of looks");
}

void GoalEstimator::add(const PlaceLook& look, const Se2& odom_from_robot) {
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(odom_from_robot.yaw_rad()).toRotationMatrix();
  looks_.push_back({.goal_in_odom = odom_from_robot * look.place_in_robot,
                    .information = (turn * look.covariance_m2 * turn.transpose()).inverse()});
  if (looks_.size() > most_looks_) {
    looks_.pop_front();
  }
  std::vector<double> x_m;
  std::vector<double> y_m;
  for (const Look& one : looks_) {
    x_m.push_back(one.goal_in_odom.x());
    y_m.push_back(one.goal_in_odom.y());
  }
  goal_in_odom_ = {quantile(x_m, 0.5), quantile(y_m, 0.5)};
  for (int step = 0; step < kSteps; ++step) {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (const Look& one : looks_) {
      const Eigen::Vector2d off = one.goal_in_odom - goal_in_odom_;
      const double weight =
          (kErrorDegrees + 2.0) / (kErrorDegrees + off.dot(one.information * off));
      information += weight * one.information;
      sum += weight * one.information * one.goal_in_odom;
    }
    goal_in_odom_ = information.inverse() * sum;
  }
}

}  // namespace sketchloc
