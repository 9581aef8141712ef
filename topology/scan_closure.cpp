#include "topology/scan_closure.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/angles.hpp"
#include "motion/check.hpp"
#include "motion/validate.hpp"
#include "registration/surface_merge.hpp"

namespace sketchloc {
namespace {

/// What was seen from poses around one, in its frame, merged.
std::vector<SurfacePoint> submap_around(const SeenRun& run, std::size_t pose,
                                        const ScanClosureParams& params) {
  const std::vector<double>& way_m = run.travel.way_m;
  const Se2 robot_from_manhattan = run.manhattan_from_robot[pose].inverse();
  std::vector<SurfacePoint> points;
  double last_way_m = -1e9;
  for (std::size_t i = 0; i < run.scans.size(); ++i) {
    const bool near = std::abs(way_m[i] - way_m[pose]) <= params.submap_way_m;
    if (!near || way_m[i] - last_way_m < params.submap_spacing_m) {
      continue;
    }
    last_way_m = way_m[i];
    const Se2 robot_from_then = robot_from_manhattan * run.manhattan_from_robot[i];
    for (const SurfacePoint& seen : surface_points_in_robot(run.scans[i], params.surface)) {
      points.push_back({.point = robot_from_then * seen.point,
                        .normal = robot_from_then.rotation_matrix() * seen.normal});
    }
  }
  SurfaceMerger merger(params.merge_cell_m);
  const std::span<const SurfacePoint> merged = merger.merge(points);
  return {merged.begin(), merged.end()};
}

Eigen::Vector3d inverse_square(const Eigen::Vector3d& sigma) {
  return sigma.cwiseProduct(sigma).cwiseInverse();
}

/// Both robots look along the aisle or back: what is across is their y, give or take a skew.
Eigen::Matrix3d prior_information(const ScanClosureParams& params) {
  return inverse_square(
             {params.along_sigma_m, params.across_sigma_m, rad_from_deg(params.heading_sigma_deg)})
      .asDiagonal();
}

/// No surer than submaps can be, whose points err together.
Eigen::Matrix3d sober(const Eigen::Matrix3d& information, const ScanClosureParams& params) {
  const Eigen::Vector3d least(params.least_sigma_m, params.least_sigma_m,
                              rad_from_deg(params.least_sigma_deg));
  const Eigen::Matrix3d floor = least.cwiseProduct(least).asDiagonal();
  // (I^-1 + F)^-1 without inverting I, which may not know a direction.
  return information * (Eigen::Matrix3d::Identity() + floor * information).inverse();
}

}  // namespace

void validate(const ScanClosureParams& params) {
  validate_part("surface", params.surface);
  validate_part("match", params.match);
  require_above("submap_way_m", params.submap_way_m, 0.0);
  require_above("submap_spacing_m", params.submap_spacing_m, 0.0);
  require_above("search_radius_m", params.search_radius_m, 0.0);
  require_above("merge_cell_m", params.merge_cell_m, 0.0);
  require_above("along_sigma_m", params.along_sigma_m, 0.0);
  require_above("across_sigma_m", params.across_sigma_m, 0.0);
  require_above("heading_sigma_deg", params.heading_sigma_deg, 0.0);
  require_in_range("least_matched_share", params.least_matched_share, 0.0, 1.0);
  require_above("least_sigma_m", params.least_sigma_m, 0.0);
  require_above("least_sigma_deg", params.least_sigma_deg, 0.0);
}

std::optional<GraphEdge> close_by_scans(const SeenRun& run, const SamePlacePair& pair,
                                        const ScanClosureParams& params) {
  check(run.scans.size() == run.manhattan_from_robot.size(), "one scan for each pose");
  const PosesBeside beside = typical(pair);
  SurfaceMap earlier(params.search_radius_m);
  earlier.refill(submap_around(run, beside.earlier, params));
  const std::vector<SurfacePoint> later = submap_around(run, beside.later, params);
  const Se2 expected =
      run.manhattan_from_robot[beside.earlier].inverse() * run.manhattan_from_robot[beside.later];
  const PosePrior prior{.odom_from_robot = expected, .information = prior_information(params)};
  const ScanMatch match = match_scan(later, earlier, prior, expected, params.match);
  if (match.status == ScanMatch::Status::TooFewPoints ||
      match.matched_share < params.least_matched_share) {
    return std::nullopt;
  }
  Eigen::Matrix3d information = sober(match.scan_information, params);
  information = 0.5 * (information + information.transpose()).eval();
  GraphEdge edge = between_edge(beside.earlier, beside.later, match.odom_from_robot, information);
  edge.may_be_wrong = true;
  return edge;
}

}  // namespace sketchloc
