#include "tests/support/scalar_end_point_model.hpp"

#include <Eigen/Core>
#include <cmath>

#include "tests/support/local_map.hpp"

namespace sketchloc::testing {
namespace {

/// The value of the cell that holds a point, or `outside`; no calls to floor, which would cost more
/// than all the rest.
double value_at(const Grid<float>& grid, double x, double y, double outside) {
  if (!(x >= 0.0 && y >= 0.0 && x < grid.width() && y < grid.height())) {
    return outside;
  }
  return grid.cells()[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width()) +
                      static_cast<std::size_t>(x)];
}

}  // namespace

std::vector<double> score_by_look_up(const Grid<float>& log_likelihood, double outside,
                                     const ParticleSpans& particles, const EndPoints& points) {
  std::vector<double> scores(particles.size(), 0.0);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Eigen::Vector2d origin(particles.x_px[i], particles.y_px[i]);
    const Eigen::Matrix2d map = local_map(particles, i);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double x = origin.x() + map(0, 0) * points.x_m[k] + map(0, 1) * points.y_m[k];
      const double y = origin.y() + map(1, 0) * points.x_m[k] + map(1, 1) * points.y_m[k];
      scores[i] += value_at(log_likelihood, x, y, outside);
    }
  }
  return scores;
}

std::vector<double> score_by_distance(const Grid<float>& distance_px, const EndPointParams& params,
                                      double farthest_px, const ParticleSpans& particles,
                                      std::span<const PolarPoint> beams) {
  std::vector<double> scores(particles.size(), 0.0);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double scale = std::exp(static_cast<double>(particles.log_scale[i]));
    for (const PolarPoint& beam : beams) {
      const double direction_rad = particles.heading_rad[i] + beam.bearing_rad;
      const double length_px = beam.range_m * scale;
      const double x = particles.x_px[i] + length_px * std::cos(direction_rad);
      const double y = particles.y_px[i] + length_px * std::sin(direction_rad);
      const double distance = value_at(distance_px, x, y, farthest_px);
      const double z = distance / params.sigma_px;
      scores[i] += std::log((1.0 - params.floor) * std::exp(-0.5 * z * z) + params.floor);
    }
  }
  return scores;
}

}  // namespace sketchloc::testing
