#include "filter/end_point_model.hpp"

#include <cmath>

#include "motion/validate.hpp"
#include "registration/distance_field.hpp"

namespace sketchloc {
namespace {

EndPointKernel make_kernel(const Sketch& sketch, double px_per_m,
                           const EndPointModelParams& params) {
  const EndPointParams field{.sigma_px = params.sigma_m * px_per_m, .floor = params.floor};
  return {likelihood_field(distance_field_px(sketch.occupied), field), std::log(params.floor)};
}

}  // namespace

void validate(const EndPointModelParams& params) {
  validate(params.selection);
  require_above("sigma_m", params.sigma_m, 0.0);
  require_in_range("floor", params.floor, 1e-6, 1.0);
  require_in_range("exponent", params.exponent, 1e-6, 1.0);
}

EndPointModel::EndPointModel(const Sketch& sketch, double px_per_m,
                             const EndPointModelParams& params)
    : params_((validate(params), params)), kernel_(make_kernel(sketch, px_per_m, params)) {}

std::size_t EndPointModel::observe(const Scan& scan) {
  x_m_.clear();
  y_m_.clear();
  select_end_points(ends_in_robot_, scan, params_.selection);
  for (const Eigen::Vector2d& end : ends_in_robot_) {
    x_m_.push_back(static_cast<float>(end.x()));
    y_m_.push_back(static_cast<float>(end.y()));
  }
  return x_m_.size();
}

void EndPointModel::score(const ParticleSet& particles, const ParticleRange& range,
                          std::span<float> log_likelihood) const {
  const std::size_t count = range.end - range.begin;
  kernel_.score(particles.spans().subspan(range.begin, count), {.x_m = x_m_, .y_m = y_m_},
                log_likelihood.subspan(range.begin, count));
}

}  // namespace sketchloc
