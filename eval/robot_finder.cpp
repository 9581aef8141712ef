#include "eval/robot_finder.hpp"

#include "motion/check.hpp"

namespace sketchloc {
namespace {

constexpr double kLeastTrust = 0.5;  ///< of a registration's own probability to be right
constexpr double kCommon_m = 0.1;    ///< error that looks at the same strokes share
constexpr double kUnstated_m = 0.4;  ///< error of a place, where nobody says how large it is

/// Of the place g of the robot's plane, where the pose errs by e: g - e(x, y) - e(heading) x g -
/// e(log scale) g, to the first order.
Eigen::Matrix2d covariance_at(const Eigen::Vector2d& place_in_robot,
                              const Eigen::Matrix4d& of_pose) {
  Eigen::Matrix<double, 2, 4> by_error;
  by_error << 1.0, 0.0, -place_in_robot.y(), place_in_robot.x(),  //
      0.0, 1.0, place_in_robot.x(), place_in_robot.y();
  return by_error * of_pose * by_error.transpose() +
         kCommon_m * kCommon_m * Eigen::Matrix2d::Identity();
}

}  // namespace

RegistrationChain::RegistrationChain(const Sketch& sketch, WarpPredictor& predictor,
                                     const LocalizationParams& params,
                                     const Sim2& start_sketch_from_robot)
    : predictor_(predictor),
      cropper_(sketch),
      recent_(params.localizer.fusion.recent),
      chain_way_m_(params.chain_way_m),
      sketch_from_robot_(start_sketch_from_robot) {}

bool RegistrationChain::step(const Scan& scan, const Se2& odom_from_robot) {
  const bool first = !last_odom_from_robot_;
  const Se2 step = last_odom_from_robot_.value_or(odom_from_robot).inverse() * odom_from_robot;
  last_odom_from_robot_ = odom_from_robot;
  sketch_from_robot_ = sketch_from_robot_ * step;
  way_m_ += step.translation().norm();
  recent_.add(scan, odom_from_robot);
  if ((!first && way_m_ < chain_way_m_) || end_points_in_robot(scan).empty()) {
    return false;
  }
  way_m_ = 0.0;
  auto found = predictor_.predict(recent_.placed(), cropper_, {&sketch_from_robot_, 1}).front();
  if (!found) {
    return false;
  }
  sketch_from_robot_ = found->sketch_from_robot;
  registration_ = std::move(found);
  odom_at_registration_ = odom_from_robot;
  return true;
}

RobotFinder::RobotFinder(const Sketch& sketch, const LocalizationMethod& method,
                         const LocalizationParams& params, WarpPredictor* predictor,
                         const Sim2& start_sketch_from_robot)
    : method_(method),
      predictor_(predictor),
      odometry_(OdometrySource::Matched, params.odometry),
      cropper_(sketch),
      recent_(params.localizer.fusion.recent),
      sketch_from_robot_(start_sketch_from_robot) {
  check(method.method != Method::Odometry, "a robot finder looks at the drawing");
  if (method.method == Method::Chained) {
    check(predictor != nullptr, "a chain registers");
    chain_.emplace(sketch, *predictor, params, start_sketch_from_robot);
  } else {
    localizer_.emplace(sketch, params_of(method, params.localizer), predictor);
    localizer_->start_at(start_sketch_from_robot);
  }
}

void RobotFinder::step(const RunStep& step) {
  odom_from_robot_ = odometry_.odom_from_robot(step);
  recent_.add(step.scan, odom_from_robot_);
  looked_now_ = false;
  if (chain_) {
    looked_now_ = chain_->step(step.scan, odom_from_robot_);
    if (looked_now_) {
      look_ = chain_->registration();
      odom_at_look_ = odom_from_robot_;
    }
    sketch_from_robot_ = chain_->sketch_from_robot();
    return;
  }
  const StepReport& report = localizer_->step(step.scan, odom_from_robot_);
  sketch_from_robot_ = report.estimate.sketch_from_robot;
  position_covariance_px2_ = report.estimate.covariance.topLeftCorner<2, 2>();
  localized_probability_ = report.localized_probability;
}

void RobotFinder::look() {
  if (chain_ || predictor_ == nullptr) {
    return;
  }
  auto found = predictor_->predict(recent_.placed(), cropper_, {&sketch_from_robot_, 1}).front();
  if (found && found->inlier_probability >= kLeastTrust) {
    look_ = std::move(found);
    odom_at_look_ = odom_from_robot_;
    looked_now_ = true;
  }
}

PlaceLook RobotFinder::look_for(const Eigen::Vector2d& place_in_sketch) const {
  const Eigen::Vector2d place_in_robot = robot_from_sketch(place_in_sketch);
  const bool is_stated = looked_now_ && look_->covariance;
  return {.place_in_robot = place_in_robot,
          .covariance_m2 = is_stated ? covariance_at(place_in_robot, *look_->covariance)
                                     : kUnstated_m * kUnstated_m * Eigen::Matrix2d::Identity()};
}

Eigen::Vector2d RobotFinder::robot_from_sketch(const Eigen::Vector2d& place_in_sketch) const {
  const Eigen::Vector2d by_pose = sketch_from_robot_.inverse() * place_in_sketch;
  const std::optional<Eigen::Vector2d> by_warp =
      look_ ? look_->warp.robot_from_sketch(place_in_sketch) : std::nullopt;
  if (!by_warp) {
    return by_pose;
  }
  const Eigen::Vector2d from_middle = *by_warp - look_->window.centre_in_robot();
  if (from_middle.cwiseAbs().maxCoeff() > 0.5 * look_->window.side_m) {
    return by_pose;  // beyond its window a warp guesses
  }
  return odom_from_robot_.inverse() * odom_at_look_ * *by_warp;
}

}  // namespace sketchloc
