#pragma once

#include <Eigen/Core>
#include <vector>

#include "datasets/scan.hpp"

namespace sketchloc {

/// An end point of a beam with the direction of the surface that it hit. Point and normal live in
/// the frame that the variable's name tells.
struct SurfacePoint {
  Eigen::Vector2d point;
  Eigen::Vector2d normal;  ///< unit length, towards the laser
};

/// How surfaces are read out of a scan.
struct SurfaceParams {
  double max_range_m = 30.0;   ///< farther end points are left out, > 0
  double spacing_m = 0.06;     ///< denser end points are thinned to this distance, >= 0
  double support_m = 0.15;     ///< neighbours this near give the normal, > 0; grows with range
  double max_gap_beams = 3.0;  ///< support of far points, in distances between beams, > 0
  double max_roughness = 0.6;  ///< thickness by length of the support of a surface, in (0, 1]
};

template <typename Visitor>
void visit_fields(SurfaceParams& params, Visitor&& visit) {
  visit("max_range_m", params.max_range_m);
  visit("spacing_m", params.spacing_m);
  visit("support_m", params.support_m);
  visit("max_gap_beams", params.max_gap_beams);
  visit("max_roughness", params.max_roughness);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const SurfaceParams& params);

/// The end points that lie on a surface (three neighbours in a line), thinned, in beam order.
std::vector<SurfacePoint> surface_points_in_robot(const Scan& scan,
                                                  const SurfaceParams& params = {});

}  // namespace sketchloc
