#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "datasets/sim/deformation.hpp"
#include "motion/trajectory.hpp"

namespace sketchloc {

/// A place on a drive and how it was drawn.
struct DrawnPlace {
  Eigen::Vector2d position_in_world;   ///< m
  Eigen::Vector2d position_in_sketch;  ///< px
  LocalSimilarity local;               ///< of the map from the world to the drawing there
};

/// 5 %, 50 % and 95 % of the values, with linear interpolation.
struct Quantiles {
  double p5 = 0.0;
  double median = 0.0;
  double p95 = 0.0;
};

/// How a drawing is wrong, along a drive: the same figures for simulated and real drawings.
struct DrawingStatistics {
  static constexpr std::array<double, 4> kLags_m = {1.0, 2.0, 5.0, 10.0};

  Quantiles scale_px_per_m;
  Quantiles rotation_rad;  ///< of the world's axes in the drawing, around its middle direction
  Quantiles anisotropy;
  double residual_rms_m = 0.0;  ///< from the best similarity, in metres at its scale
  /// RMS of how much that residual differs between places kLags_m apart (+-20 %, straight line);
  /// NaN where no two places are.
  std::array<double, 4> residual_change_m{};
};

/// Figures over the way driven (not over scans). Needs a drive of at least two different places.
DrawingStatistics measure_drawing(std::span<const DrawnPlace> drive);

/// How a deformation draws the places of a drive.
std::vector<DrawnPlace> drawn_places(const MetricTrajectory& world_from_robot,
                                     const Deformation& sketch_from_world);

/// Quantiles of values (at least one; linear interpolation between the sorted values).
Quantiles quantiles(std::vector<double> values);

}  // namespace sketchloc
