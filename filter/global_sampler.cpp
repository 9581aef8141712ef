#include "filter/global_sampler.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/check.hpp"

namespace sketchloc {
namespace {

constexpr double kHitsFromInside = 0.9;  ///< share of directions that end at a stroke

struct View {
  int hits = 0;
  double mean_square_px = 0.0;  ///< of the ranges that end at a stroke
};

View view_from(const RangeTable& table, std::span<const double> square_px, std::size_t cell) {
  View view;
  const std::span<const std::int8_t> codes =
      table.codes().subspan(cell * RangeTable::kHeadings, RangeTable::kHeadings);
  for (const std::int8_t code : codes) {
    if (code != RangeTable::kNothing) {
      ++view.hits;
      view.mean_square_px += square_px[static_cast<std::size_t>(code - RangeTable::kNearest)];
    }
  }
  view.mean_square_px /= std::max(view.hits, 1);
  return view;
}

}  // namespace

GlobalSampler::GlobalSampler(const Sketch& sketch, const RangeTable& table)
    : cell_px_(table.cell_px()) {
  std::vector<double> square_px;
  for (int code = RangeTable::kNearest; code <= RangeTable::kNothing; ++code) {
    const double range_px = table.range_px(static_cast<std::int8_t>(code));
    square_px.push_back(range_px * range_px);
  }
  std::vector<double> log_radius;
  for (int row = 0; row < table.rows(); ++row) {
    for (int column = 0; column < table.columns(); ++column) {
      const Cell pixel{std::min(column * cell_px_ + cell_px_ / 2, sketch.width_px() - 1),
                       std::min(row * cell_px_ + cell_px_ / 2, sketch.height_px() - 1)};
      if (sketch.occupied.at(pixel) != 0) {
        continue;
      }
      const auto cell = static_cast<std::size_t>(row) * static_cast<std::size_t>(table.columns()) +
                        static_cast<std::size_t>(column);
      const View view = view_from(table, square_px, cell);
      if (view.hits >= kHitsFromInside * RangeTable::kHeadings) {
        free_cells_.push_back({column, row});
        log_radius.push_back(0.5 * std::log(view.mean_square_px));
      }
    }
  }
  if (!log_radius.empty()) {
    const auto middle = log_radius.begin() + static_cast<std::ptrdiff_t>(log_radius.size() / 2);
    std::ranges::nth_element(log_radius, middle);
    median_log_visible_radius_ = *middle;
  }
}

void GlobalSampler::draw(ParticleSet& particles, const ParticleRange& range,
                         const ScalePrior& scale, double strain_sigma, Rng& rng) const {
  check(!empty(), "the drawing has no place that strokes enclose");
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const auto pick =
        static_cast<std::size_t>(uniform(rng) * static_cast<double>(free_cells_.size()));
    const Cell cell = free_cells_[pick];
    particles.x_px[i] = static_cast<float>(cell_px_ * (cell.column + uniform(rng)));
    particles.y_px[i] = static_cast<float>(cell_px_ * (cell.row + uniform(rng)));
    particles.heading_rad[i] =
        static_cast<float>(uniform(-std::numbers::pi, std::numbers::pi, rng));
    particles.log_mean_scale[i] =
        static_cast<float>(scale.log_px_per_m + gaussian(scale.sigma, rng));
    particles.log_scale[i] = particles.log_mean_scale[i];
    particles.axial_strain[i] = static_cast<float>(gaussian(strain_sigma, rng));
    particles.diagonal_strain[i] = static_cast<float>(gaussian(strain_sigma, rng));
    particles.log_weight[i] = 0.0F;
  }
}

}  // namespace sketchloc
