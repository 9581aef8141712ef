#include "tests/support/scalar_beam_model.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/grid_traversal.hpp"
#include "tests/support/local_map.hpp"

namespace sketchloc::testing {
namespace {

double log_kernel(const BeamKernelParams& params, const Beam& beam, double log_ratio) {
  const double z = log_ratio / params.sigma;
  if (beam.returned) {
    return std::log((1.0 - params.floor) * std::exp(-0.5 * z * z) + params.floor);
  }
  const double below = 0.5 * std::erfc(z / std::numbers::sqrt2);
  return std::log((1.0 - params.no_return_floor) * below + params.no_return_floor);
}

}  // namespace

std::vector<double> score_by_traversal(const Grid<std::uint8_t>& occupied,
                                       const BeamKernelParams& params,
                                       const ParticleSpans& particles, std::span<const Beam> beams,
                                       double max_range_px) {
  std::vector<double> scores(particles.size(), 0.0);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Eigen::Vector2d origin(particles.x_px[i], particles.y_px[i]);
    const Eigen::Matrix2d sketch_from_robot = local_map(particles, i);
    for (const Beam& beam : beams) {
      const double bearing_rad = beam.bearing_rad;
      const Eigen::Vector2d drawn =
          sketch_from_robot * Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
      const double expected =
          std::max(0.5, traverse_beyond_own_stroke(occupied, origin,
                                                   std::atan2(drawn.y(), drawn.x()), max_range_px));
      const double measured = beam.range_m * drawn.norm() * std::exp(beam.log_stretch);
      scores[i] += log_kernel(params, beam, std::log(measured / expected));
    }
  }
  return scores;
}

}  // namespace sketchloc::testing
