#pragma once

#include <Eigen/Core>
#include <span>

#include "motion/se2.hpp"
#include "registration/surface_map.hpp"
#include "registration/surface_points.hpp"

namespace sketchloc {

/// Robust point-to-line ICP with a prior. [Censi08]
struct ScanMatchParams {
  double point_sigma_m = 0.03;     ///< noise of one point across its line, > 0
  double independent_share = 0.2;  ///< share of points that count as independent, in (0, 1]
  double kernel_m = 0.1;           ///< residual at which a point loses its say, > 0
  int min_points = 10;             ///< fewer points with a partner are no match, >= 3
  double min_matched_share = 0.2;  ///< of the points, with a partner within kernel_m, in [0, 1]
  int max_iterations = 25;         ///< >= 1
  double stop_m = 1e-4;            ///< a step below this (m and rad) ends the iteration, > 0
};

template <typename Visitor>
void visit_fields(ScanMatchParams& params, Visitor&& visit) {
  visit("point_sigma_m", params.point_sigma_m);
  visit("independent_share", params.independent_share);
  visit("kernel_m", params.kernel_m);
  visit("min_points", params.min_points);
  visit("min_matched_share", params.min_matched_share);
  visit("max_iterations", params.max_iterations);
  visit("stop_m", params.stop_m);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const ScanMatchParams& params);

/// A pose with the information matrix (inverse covariance) of its error in the robot frame:
/// (x m, y m, yaw rad).
struct PosePrior {
  Se2 odom_from_robot;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
};

struct ScanMatch {
  enum class Status { Converged, IterationLimit, TooFewPoints };
  Status status = Status::TooFewPoints;
  Se2 odom_from_robot;  ///< best estimate so far, whatever the status
  Eigen::Matrix3d scan_information = Eigen::Matrix3d::Zero();  ///< of the scan alone, robot frame
  double matched_share = 0.0;  ///< of the points, with a partner within kernel_m
  double cost = 0.0;           ///< robust misfit of scan and prior, comparable for one scan
};

/// Aligns the points with the map, starting at `start`, under the prior.
ScanMatch match_scan(std::span<const SurfacePoint> points_in_robot, const SurfaceMap& map_in_odom,
                     const PosePrior& prior, const Se2& start_odom_from_robot,
                     const ScanMatchParams& params = {});

}  // namespace sketchloc
