#pragma once

#include <Eigen/Core>
#include <deque>
#include <vector>

#include "datasets/scan.hpp"
#include "motion/odometry.hpp"
#include "motion/state_bytes.hpp"
#include "registration/pose_search.hpp"
#include "registration/scan_matcher.hpp"
#include "registration/surface_map.hpp"
#include "registration/surface_merge.hpp"
#include "registration/surface_points.hpp"

namespace sketchloc {

/// What a raw wheel odometry increment is worth, wide enough for poor wheels and late stamps.
struct WheelPrior {
  OdometryNoise noise{.slip_m_per_m = 0.1,
                      .slip_m_per_rad = 0.06,
                      .turn_rad_per_m = 0.06,
                      .turn_rad_per_rad = 0.15};
  double floor_m = 0.02;     ///< 1-sigma of an increment without motion, > 0
  double floor_rad = 0.015;  ///< the same for the heading, > 0
};

template <typename Visitor>
void visit_fields(WheelPrior& wheels, Visitor&& visit) {
  visit("noise", wheels.noise);
  visit("floor_m", wheels.floor_m);
  visit("floor_rad", wheels.floor_rad);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const WheelPrior& wheels);

struct MatchedOdometryParams {
  SurfaceParams surface;
  PoseSearchParams search;
  ScanMatchParams match;
  WheelPrior wheels;
  double merge_cell_m = 0.06;      ///< points of the submap are merged within this, > 0
  double search_radius_m = 0.2;    ///< reach of the nearest-neighbour look-up, > 0
  double keyframe_way_m = 0.4;     ///< a scan this far from the last keyframe is a new one, > 0
  double keyframe_turn_rad = 0.4;  ///< or turned by this much, > 0
  int max_keyframes = 80;          ///< kept in the submap, >= 1
  double submap_radius_m = 15.0;   ///< keyframes farther from the robot are dropped, > 0
};

template <typename Visitor>
void visit_fields(MatchedOdometryParams& params, Visitor&& visit) {
  visit("surface", params.surface);
  visit("search", params.search);
  visit("match", params.match);
  visit("wheels", params.wheels);
  visit("merge_cell_m", params.merge_cell_m);
  visit("search_radius_m", params.search_radius_m);
  visit("keyframe_way_m", params.keyframe_way_m);
  visit("keyframe_turn_rad", params.keyframe_turn_rad);
  visit("max_keyframes", params.max_keyframes);
  visit("submap_radius_m", params.submap_radius_m);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const MatchedOdometryParams& params);

/// One scan's worth of refined odometry.
struct MatchedStep {
  enum class Status {
    First,         ///< nothing to match with yet
    Matched,       ///< the scan decided in all directions
    Degenerate,    ///< the wheels decided in at least one direction (a long corridor)
    TooFewPoints,  ///< the wheels decided all: too little to see
    Rejected       ///< the wheels decided all: the scan does not fit what was seen before
  };
  Status status = Status::First;
  Se2 odom_from_robot;      ///< refined; starts at the first raw pose, drifts slowly
  Se2 previous_from_robot;  ///< refined increment since the step before
  Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Zero();  ///< of the increment's error d,
                                ///< truth = increment * exp(d): (x m, y m, yaw rad)
  double matched_share = 0.0;   ///< of the scan's points that lie on the submap, in [0, 1]
};

/// Refines wheel odometry by matching each scan with a submap of the last keyframes; online and
/// causal: a step depends on the steps before it only. Deterministic.
class MatchedOdometry {
 public:
  /// Throws std::invalid_argument if a parameter is out of range.
  explicit MatchedOdometry(const MatchedOdometryParams& params = {});

  /// Takes the next scan with the raw odometry at its instant.
  MatchedStep step(const Scan& scan, const Se2& raw_odom_from_robot);

  /// What it knows, exactly; the submap is made again from its keyframes.
  void save(StateWriter& state) const;
  void load(StateReader& state);

 private:
  struct Keyframe {
    Se2 odom_from_robot;
    std::vector<SurfacePoint> points_in_robot;
  };

  MatchedStep match(const std::vector<SurfacePoint>& points_in_robot, const Se2& raw_increment);
  /// All matches from the candidates of the search, best first.
  std::vector<ScanMatch> solve(const std::vector<SurfacePoint>& points_in_robot,
                               const PosePrior& prior, const Eigen::Vector3d& prior_sigma);
  void remember(std::vector<SurfacePoint> points_in_robot);
  bool keyframe_is_due() const;
  void rebuild_submap();

  MatchedOdometryParams params_;
  PoseSearch search_;
  bool started_ = false;
  Se2 raw_odom_from_robot_;
  Se2 odom_from_robot_;
  std::deque<Keyframe> keyframes_;
  std::vector<SurfacePoint> submap_points_in_odom_;
  SurfaceMerger merger_;
  SurfaceMap submap_;
  SurfaceGrid submap_grid_;
};

}  // namespace sketchloc
