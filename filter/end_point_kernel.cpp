#include "filter/end_point_kernel.hpp"

#include <algorithm>
#include <cmath>

#include "filter/detail/end_point_score.hpp"
#include "motion/check.hpp"
#include "motion/validate.hpp"

namespace sketchloc {

void validate(const EndPointParams& params) {
  require_above("sigma_px", params.sigma_px, 0.0);
  require_above("floor", params.floor, 0.0);
  require_in_range("floor", params.floor, 0.0, 1.0);
}

Grid<float> likelihood_field(const Grid<float>& distance_px, const EndPointParams& params) {
  validate(params);
  Grid<float> field(distance_px.width(), distance_px.height());
  for (int row = 0; row < field.height(); ++row) {
    const std::span<float> values = field.row(row);
    std::ranges::transform(distance_px.row(row), values.begin(), [&params](float distance) {
      const double z = distance / params.sigma_px;
      return static_cast<float>(
          std::log((1.0 - params.floor) * std::exp(-0.5 * z * z) + params.floor));
    });
  }
  return field;
}

EndPointKernel::EndPointKernel(const Grid<float>& log_likelihood, double outside)
    : width_(log_likelihood.width()), height_(log_likelihood.height()), least_(outside) {
  double most = outside;
  for (const float value : log_likelihood.cells()) {
    least_ = std::min<double>(least_, value);
    most = std::max<double>(most, value);
  }
  check(std::isfinite(least_) && std::isfinite(most), "log-likelihoods are finite");
  unit_ = std::max(most - least_, 1e-300) / 65535.0;
  const auto integer = [this](double value) {
    return static_cast<std::uint16_t>(std::lround((value - least_) / unit_));
  };
  const std::size_t pitch = static_cast<std::size_t>(width_) + 1;
  field_.assign(pitch * (static_cast<std::size_t>(height_) + 1), integer(outside));
  for (int row = 0; row < height_; ++row) {
    const auto from = static_cast<std::ptrdiff_t>(pitch * static_cast<std::size_t>(row));
    std::ranges::transform(log_likelihood.row(row), field_.begin() + from, integer);
  }
}

void EndPointKernel::score(const ParticleSpans& particles, const EndPoints& points,
                           std::span<float> log_likelihood) const {
  check_lengths(particles);
  check(log_likelihood.size() == particles.size(), "one log-likelihood per particle");
  check(points.y_m.size() == points.x_m.size(), "one y per x");
  detail::score_end_points(particles, points, {field_.data(), width_, height_}, {unit_, least_},
                           log_likelihood);
}

}  // namespace sketchloc
