#pragma once

#include <span>
#include <vector>

#include "datasets/grid.hpp"
#include "filter/end_point_kernel.hpp"

namespace sketchloc::testing {

/// One beam as a scanner gives it.
struct PolarPoint {
  double bearing_rad = 0.0;
  double range_m = 0.0;
};

/// Oracle and stronger baseline of the end-point kernel, the way of the fastest of today's
/// localizers: end points once per scan, one rotation per particle, then per point in double a
/// transform, a bounds check and a look-up of the ready log-likelihood.
std::vector<double> score_by_look_up(const Grid<float>& log_likelihood, double outside,
                                     const ParticleSpans& particles, const EndPoints& points);

/// Baseline in the way of the most used localizer: per beam in double a sine and a cosine, a bounds
/// check, a look-up of the distance to the nearest obstacle, an exponential and a logarithm.
std::vector<double> score_by_distance(const Grid<float>& distance_px, const EndPointParams& params,
                                      double farthest_px, const ParticleSpans& particles,
                                      std::span<const PolarPoint> beams);

}  // namespace sketchloc::testing
