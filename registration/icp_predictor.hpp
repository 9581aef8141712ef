#pragma once

#include <memory>

#include "registration/warp_predictor.hpp"

namespace sketchloc {

/// FPFH features, Fast Global Registration and point-to-plane ICP, the baseline of [Chen20]. Tuned
/// on simulated plans without deformation; Open3D's own tuple_scale of 0.95 finds nothing in 19 of
/// 20 deformed drawings.
struct IcpParams {
  double side_m = 16.0;           ///< of the square around the prior that is registered, > 0
  int max_scans = 1;              ///< of the submap, the present one first, >= 1
  double max_gap_m = 0.5;         ///< between neighbouring beams that hit one wall, >= 0
  double voxel_m = 0.15;          ///< distance of points in both clouds, > 0
  int layers = 3;                 ///< of points that stand for a wall's height, odd, >= 1
  double normal_radius_m = 0.4;   ///< neighbours that give a point its normal, > 0
  double feature_radius_m = 2.5;  ///< neighbours that give a point its feature, > 0
  double tuple_scale = 0.8;       ///< least ratio of lengths in matched triangles, in (0, 1]
  int tuples = 1000;              ///< triangles that are matched at most, >= 1
  double icp_distance_m = 0.6;    ///< ICP pairs points this near, > 0
  int icp_iterations = 50;        ///< >= 1
};

template <typename Visitor>
void visit_fields(IcpParams& params, Visitor&& visit) {
  visit("side_m", params.side_m);
  visit("max_scans", params.max_scans);
  visit("max_gap_m", params.max_gap_m);
  visit("voxel_m", params.voxel_m);
  visit("layers", params.layers);
  visit("normal_radius_m", params.normal_radius_m);
  visit("feature_radius_m", params.feature_radius_m);
  visit("tuple_scale", params.tuple_scale);
  visit("tuples", params.tuples);
  visit("icp_distance_m", params.icp_distance_m);
  visit("icp_iterations", params.icp_iterations);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const IcpParams& params);

/// Whether this build has the predictor (CMake option SKETCHLOC_OPEN3D).
bool icp_is_built();

/// Registers a rigid motion; the scale stays the prior's, and the share of the scan's points that
/// end on strokes stands for the probability. None where nothing matches. Each prior's result is
/// its own, whatever came before. Uses Open3D's global random numbers and log level: not to be used
/// by several threads at once. Throws std::runtime_error where it is not built.
std::unique_ptr<WarpPredictor> make_icp_predictor(const IcpParams& params = {});

}  // namespace sketchloc
