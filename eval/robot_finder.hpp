#pragma once

#include <Eigen/Core>
#include <optional>

#include "eval/goal_estimator.hpp"
#include "eval/localization_methods.hpp"
#include "registration/recent_scans.hpp"

namespace sketchloc {

/// One registration after the other [Chen20], each from the last one's pose; odometry between.
class RegistrationChain {
 public:
  /// Sketch and predictor must outlive the chain.
  RegistrationChain(const Sketch& sketch, WarpPredictor& predictor,
                    const LocalizationParams& params, const Sim2& start_sketch_from_robot);

  /// Takes the next scan; whether it was registered.
  bool step(const Scan& scan, const Se2& odom_from_robot);

  const Sim2& sketch_from_robot() const { return sketch_from_robot_; }
  /// The last one, and the odometry at its instant.
  const std::optional<Registration>& registration() const { return registration_; }
  const Se2& odom_at_registration() const { return odom_at_registration_; }

 private:
  WarpPredictor& predictor_;
  SketchCropper cropper_;
  RecentScans recent_;
  double chain_way_m_;
  Sim2 sketch_from_robot_;
  std::optional<Se2> last_odom_from_robot_;
  double way_m_ = 0.0;
  std::optional<Registration> registration_;
  Se2 odom_at_registration_;
};

/// A robot that drives and asks after every scan where it is, by any of localization_methods() but
/// dead reckoning.
class RobotFinder {
 public:
  /// Sketch and predictor must outlive the finder.
  RobotFinder(const Sketch& sketch, const LocalizationMethod& method,
              const LocalizationParams& params, WarpPredictor* predictor,
              const Sim2& start_sketch_from_robot);

  /// Takes the next scan with the wheels' odometry at its instant.
  void step(const RunStep& step);

  const Sim2& sketch_from_robot() const { return sketch_from_robot_; }
  /// Of the position, sketch frame; none where the method does not tell.
  const std::optional<Eigen::Matrix2d>& position_covariance_px2() const {
    return position_covariance_px2_;
  }
  double localized_probability() const { return localized_probability_; }
  const Se2& odom_from_robot() const { return odom_from_robot_; }

  /// Where a place of the drawing lies, in the robot's metres: through the warp of a registration
  /// of the scans around the robot if it reaches so far, else through the pose. The inverse of the
  /// local map: near a goal it tells more than the pose.
  Eigen::Vector2d robot_from_sketch(const Eigen::Vector2d& place_in_sketch) const;

  /// The same with how exact it says to be.
  PlaceLook look_for(const Eigen::Vector2d& place_in_sketch) const;

  /// Registers from the pose, for robot_from_sketch(); nothing with methods that do not register.
  void look();

 private:
  const LocalizationMethod method_;
  WarpPredictor* predictor_;
  OdometryFeed odometry_;
  std::optional<RegistrationChain> chain_;
  std::optional<Localizer> localizer_;
  SketchCropper cropper_;
  RecentScans recent_;
  Sim2 sketch_from_robot_;
  Se2 odom_from_robot_;
  std::optional<Eigen::Matrix2d> position_covariance_px2_;
  double localized_probability_ = 1.0;
  std::optional<Registration> look_;
  Se2 odom_at_look_;
  bool looked_now_ = false;  ///< at the last scan
};

}  // namespace sketchloc
