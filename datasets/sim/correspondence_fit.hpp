#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "datasets/reference.hpp"
#include "datasets/sim/deformation.hpp"
#include "motion/trajectory.hpp"
#include "registration/plane_map.hpp"

namespace sketchloc {

/// A place of the world (m) and where it was drawn (px).
struct PlacePair {
  Eigen::Vector2d point_in_world;
  Eigen::Vector2d point_in_sketch;
};

struct CorrespondenceFitParams {
  /// Places nearer than this say the same twice (two annotators), so that they are left out
  /// together where an error is measured, > 0.
  double same_place_m = 1.0;
};

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const CorrespondenceFitParams& params);

/// How somebody's drawing distorts the world, as far as a few places tell.
struct CorrespondenceFit {
  enum class Status {
    Fitted,
    TooFewPlaces,  ///< fewer than three apart from each other: no error can be measured
    Folded         ///< every map that the places allow mirrors or folds the layout
  };
  enum class Kind { Similarity, Affine, ThinPlateSpline };

  Status status = Status::TooFewPlaces;
  Kind kind = Kind::Similarity;
  double smoothing_m2 = 0.0;  ///< of the spline, see TpsSolver
  Deformation sketch_from_world{};
  double residual_px = 0.0;  ///< RMS over the places
  double left_out_px = 0.0;  ///< RMS error at a place when it and those near it are left out
  double left_out_m = 0.0;   ///< the same, each error by the local scale at its place
  std::vector<Eigen::Vector2d> hull_in_world{};  ///< convex hull of the places, counter-clockwise
};

/// Of a similarity, an affine map and thin plate splines from stiff to soft, the one with the least
/// error at places left out, among those that do not fold anywhere in the layout. So few places say
/// little about local distortion: the measured error is the reference's uncertainty, and it is
/// slightly flattered by having chosen the map.
CorrespondenceFit fit_correspondences(std::span<const PlacePair> places,
                                      const PlaneBox& layout_in_world,
                                      const CorrespondenceFitParams& params = {});

/// The reference with the fit's uncertainty; scored only where the fit is supported, inside the
/// hull of its places. Needs one true pose per reference pose.
Reference with_support(Reference reference, const CorrespondenceFit& fit,
                       const MetricTrajectory& world_from_robot);

}  // namespace sketchloc
