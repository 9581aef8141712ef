#include "registration/matched_odometry.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "motion/check.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

const MatchedOdometryParams& validated(const MatchedOdometryParams& params) {
  validate(params);
  return params;
}

Eigen::Vector3d wheel_sigma(const Se2& raw_increment, const WheelPrior& wheels) {
  const Eigen::Vector3d floor(wheels.floor_m, wheels.floor_m, wheels.floor_rad);
  return (increment_sigma(raw_increment, wheels.noise).array().square() + floor.array().square())
      .sqrt();
}

/// Covariance of the best match, widened by other matches that explain the scan nearly as well:
/// second moment of the mixture about the best.
Eigen::Matrix3d covariance_with_rivals(std::span<const ScanMatch> matches,
                                       const Eigen::Matrix3d& prior_information) {
  const ScanMatch& best = matches.front();
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double weights = 0.0;
  for (const ScanMatch& match : matches) {
    const double weight = std::exp(0.5 * (best.cost - match.cost));
    const Eigen::Vector3d offset = (best.odom_from_robot.inverse() * match.odom_from_robot).log();
    const Eigen::Matrix3d covariance = (match.scan_information + prior_information).inverse();
    sum += weight * (covariance + offset * offset.transpose());
    weights += weight;
  }
  return sum / weights;
}

/// Whether the prior weighs more than the scan in some direction.
bool prior_decides_somewhere(const Eigen::Matrix3d& scan_information,
                             const Eigen::Vector3d& prior_sigma) {
  const Eigen::Matrix3d scan_by_prior =
      prior_sigma.asDiagonal() * scan_information * prior_sigma.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scan_by_prior,
                                                              Eigen::EigenvaluesOnly);
  return solver.eigenvalues().minCoeff() < 1.0;
}

}  // namespace

void validate(const WheelPrior& wheels) {
  validate(wheels.noise);
  require_above("floor_m", wheels.floor_m, 0.0);
  require_above("floor_rad", wheels.floor_rad, 0.0);
}

void validate(const MatchedOdometryParams& params) {
  validate(params.surface);
  validate(params.search);
  validate(params.match);
  validate(params.wheels);
  require_above("merge_cell_m", params.merge_cell_m, 0.0);
  require_above("search_radius_m", params.search_radius_m, 0.0);
  require_above("keyframe_way_m", params.keyframe_way_m, 0.0);
  require_above("keyframe_turn_rad", params.keyframe_turn_rad, 0.0);
  require_at_least("max_keyframes", params.max_keyframes, 1.0);
  require_above("submap_radius_m", params.submap_radius_m, 0.0);
}

MatchedOdometry::MatchedOdometry(const MatchedOdometryParams& params)
    : params_(validated(params)),
      search_(params.search),
      merger_(params.merge_cell_m),
      submap_(params.search_radius_m),
      submap_grid_(params.search) {}

MatchedStep MatchedOdometry::step(const Scan& scan, const Se2& raw_odom_from_robot) {
  check(
      raw_odom_from_robot.translation().allFinite() && std::isfinite(raw_odom_from_robot.yaw_rad()),
      "odometry is finite");
  std::vector<SurfacePoint> points_in_robot = surface_points_in_robot(scan, params_.surface);
  MatchedStep result;
  if (started_) {
    const Se2 raw_increment = odometry_increment(raw_odom_from_robot_, raw_odom_from_robot);
    result = match(points_in_robot, raw_increment);
  } else {
    result.odom_from_robot = raw_odom_from_robot;
    started_ = true;
  }
  raw_odom_from_robot_ = raw_odom_from_robot;
  odom_from_robot_ = result.odom_from_robot;
  if (keyframe_is_due() && !points_in_robot.empty()) {
    remember(std::move(points_in_robot));
  }
  return result;
}

MatchedStep MatchedOdometry::match(const std::vector<SurfacePoint>& points_in_robot,
                                   const Se2& raw_increment) {
  const Eigen::Vector3d sigma = wheel_sigma(raw_increment, params_.wheels);
  const Eigen::Vector3d variance = sigma.array().square();
  const PosePrior prior{odom_from_robot_ * raw_increment,
                        variance.cwiseInverse().asDiagonal().toDenseMatrix()};
  const std::vector<ScanMatch> matches = solve(points_in_robot, prior, sigma);

  MatchedStep step{.status = MatchedStep::Status::TooFewPoints,
                   .odom_from_robot = prior.odom_from_robot,
                   .previous_from_robot = raw_increment,
                   .covariance = variance.asDiagonal()};
  if (matches.empty()) {
    return step;
  }
  const ScanMatch& best = matches.front();
  step.matched_share = best.matched_share;
  if (best.matched_share < params_.match.min_matched_share) {
    step.status = MatchedStep::Status::Rejected;
    return step;
  }
  step.status = prior_decides_somewhere(best.scan_information, sigma)
                    ? MatchedStep::Status::Degenerate
                    : MatchedStep::Status::Matched;
  step.odom_from_robot = best.odom_from_robot;
  step.previous_from_robot = odom_from_robot_.inverse() * best.odom_from_robot;
  step.covariance = covariance_with_rivals(matches, prior.information);
  return step;
}

std::vector<ScanMatch> MatchedOdometry::solve(const std::vector<SurfacePoint>& points_in_robot,
                                              const PosePrior& prior,
                                              const Eigen::Vector3d& prior_sigma) {
  std::vector<ScanMatch> matches;
  for (const PoseCandidate& candidate :
       search_.search(points_in_robot, submap_grid_, prior.odom_from_robot, prior_sigma)) {
    const ScanMatch match =
        match_scan(points_in_robot, submap_, prior, candidate.odom_from_robot, params_.match);
    if (match.status != ScanMatch::Status::TooFewPoints) {
      matches.push_back(match);
    }
  }
  std::stable_sort(matches.begin(), matches.end(),
                   [](const ScanMatch& a, const ScanMatch& b) { return a.cost < b.cost; });
  return matches;
}

bool MatchedOdometry::keyframe_is_due() const {
  if (keyframes_.empty()) {
    return true;
  }
  const Se2 keyframe_from_robot = keyframes_.back().odom_from_robot.inverse() * odom_from_robot_;
  return keyframe_from_robot.translation().norm() > params_.keyframe_way_m ||
         std::abs(keyframe_from_robot.yaw_rad()) > params_.keyframe_turn_rad;
}

void MatchedOdometry::remember(std::vector<SurfacePoint> points_in_robot) {
  keyframes_.push_back({odom_from_robot_, std::move(points_in_robot)});
  const auto is_far = [&](const Keyframe& keyframe) {
    const Eigen::Vector2d way =
        keyframe.odom_from_robot.translation() - odom_from_robot_.translation();
    return way.norm() > params_.submap_radius_m;
  };
  std::erase_if(keyframes_, is_far);
  if (keyframes_.size() > static_cast<std::size_t>(params_.max_keyframes)) {
    keyframes_.pop_front();
  }
  rebuild_submap();
}

void MatchedOdometry::rebuild_submap() {
  submap_points_in_odom_.clear();
  for (const Keyframe& keyframe : keyframes_) {
    const Eigen::Matrix2d rotation = keyframe.odom_from_robot.rotation_matrix();
    for (const SurfacePoint& surface : keyframe.points_in_robot) {
      submap_points_in_odom_.push_back(
          {keyframe.odom_from_robot * surface.point, rotation * surface.normal});
    }
  }
  const std::span<const SurfacePoint> merged_in_odom = merger_.merge(submap_points_in_odom_);
  submap_.refill(merged_in_odom);
  submap_grid_.refill(merged_in_odom);
}

void MatchedOdometry::save(StateWriter& state) const {
  state.put(started_);
  state.put(raw_odom_from_robot_);
  state.put(odom_from_robot_);
  state.put<std::uint64_t>(keyframes_.size());
  for (const Keyframe& keyframe : keyframes_) {
    state.put(keyframe.odom_from_robot);
    state.put<std::uint64_t>(keyframe.points_in_robot.size());
    for (const SurfacePoint& surface : keyframe.points_in_robot) {
      state.put(surface.point);
      state.put(surface.normal);
    }
  }
}

void MatchedOdometry::load(StateReader& state) {
  constexpr std::size_t kMostPoints = 1'000'000;
  started_ = state.get<bool>();
  raw_odom_from_robot_ = state.get_se2();
  odom_from_robot_ = state.get_se2();
  keyframes_.resize(state.get_count(static_cast<std::size_t>(params_.max_keyframes)));
  for (Keyframe& keyframe : keyframes_) {
    keyframe.odom_from_robot = state.get_se2();
    const std::size_t count = state.get_count(kMostPoints);
    keyframe.points_in_robot.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector2d point = state.get_matrix<2, 1>();
      keyframe.points_in_robot.push_back({point, state.get_matrix<2, 1>()});
    }
  }
  rebuild_submap();
}

}  // namespace sketchloc
