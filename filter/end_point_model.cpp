#include "filter/end_point_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "motion/validate.hpp"
#include "registration/distance_field.hpp"

namespace sketchloc {
namespace {

/// Distance from each cell's centre to the nearest border between a stroke and the rest. Beams end
/// on a wall's face, not within it: with the distance to occupied cells, zero all through the wall,
/// a robot that looks one way is drawn towards what it sees by half a cell and more.
Grid<float> distance_to_face_px(const Grid<std::uint8_t>& occupied) {
  Grid<std::uint8_t> free(occupied.width(), occupied.height());
  for (int row = 0; row < occupied.height(); ++row) {
    std::ranges::transform(occupied.row(row), free.row(row).begin(),
                           [](std::uint8_t cell) { return cell == 0 ? 1 : 0; });
  }
  Grid<float> distance_px = distance_field_px(occupied);
  const Grid<float> depth_px = distance_field_px(free);
  for (int row = 0; row < occupied.height(); ++row) {
    const std::span<float> cells = distance_px.row(row);
    std::ranges::transform(cells, depth_px.row(row), cells.begin(), [](float away, float deep) {
      return std::max(away, deep) - 0.5F;  // one of both is zero
    });
  }
  return distance_px;
}

EndPointKernel make_kernel(const Sketch& sketch, double px_per_m,
                           const EndPointModelParams& params) {
  const EndPointParams field{.sigma_px = params.sigma_m * px_per_m, .floor = params.floor};
  return {likelihood_field(distance_to_face_px(sketch.occupied), field), std::log(params.floor)};
}

}  // namespace

void validate(const EndPointModelParams& params) {
  validate_part("selection", params.selection);
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
  select_beams(selected_, scan, params_.selection);
  for (const auto& [end, returned] : selected_) {
    if (returned) {
      x_m_.push_back(static_cast<float>(end.x()));
      y_m_.push_back(static_cast<float>(end.y()));
    }
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
