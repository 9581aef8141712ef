#pragma once

#include <Eigen/Core>
#include <deque>

#include "motion/se2.hpp"

namespace sketchloc {

/// Where a place of the drawing lies, as one look says.
struct PlaceLook {
  Eigen::Vector2d place_in_robot = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Identity();
};

/// Where a goal lies, of many looks at it: the most likely place where their errors are those of a
/// Student t, as registrations state them. Odometry joins the looks.
class GoalEstimator {
 public:
  /// Remembers so many looks, >= 1.
  explicit GoalEstimator(int most_looks);

  void add(const PlaceLook& look, const Se2& odom_from_robot);

  /// Not before the first look.
  Eigen::Vector2d goal_in_odom() const { return goal_in_odom_; }

 private:
  struct Look {
    Eigen::Vector2d goal_in_odom;
    Eigen::Matrix2d information;
  };

  std::size_t most_looks_;
  std::deque<Look> looks_;
  Eigen::Vector2d goal_in_odom_ = Eigen::Vector2d::Zero();
};

}  // namespace sketchloc
