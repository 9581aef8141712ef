#include "planning/scale_field.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/check.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

constexpr double kCell_px = 8.0;  // far below any reach that makes sense

double mean_log_scale(std::span<const ScaleSample> samples) {
  double sum = 0.0;
  for (const ScaleSample& sample : samples) {
    sum += std::log(sample.px_per_m);
  }
  return sum / static_cast<double>(samples.size());
}

/// Between which coarse cells a px lies, and how far from the first to the second.
struct Between {
  int first = 0;
  int second = 0;
  double share = 0.0;
};

Between between(int px, int coarse_cells) {
  const double from_first_centre =
      std::clamp((px + 0.5) / kCell_px - 0.5, 0.0, static_cast<double>(coarse_cells - 1));
  const int first = static_cast<int>(from_first_centre);
  return {first, std::min(first + 1, coarse_cells - 1), from_first_centre - first};
}

}  // namespace

void validate(const ScaleFieldParams& params) {
  require_above("reach_px", params.reach_px, 0.0);
  require_above("mean_weight", params.mean_weight, 0.0);
}

ScaleField::ScaleField(double px_per_m) : elsewhere_px_per_m_(px_per_m) {
  check(px_per_m > 0.0, "a scale is above 0");
}

ScaleField::ScaleField(int width_px, int height_px, std::span<const ScaleSample> samples,
                       const ScaleFieldParams& params) {
  check(!samples.empty(), "a scale field needs a sample");
  const double mean = mean_log_scale(samples);
  elsewhere_px_per_m_ = std::exp(mean);
  log_px_per_m_ = Grid<float>(static_cast<int>(std::ceil(width_px / kCell_px)) + 1,
                              static_cast<int>(std::ceil(height_px / kCell_px)) + 1);
  for (int row = 0; row < log_px_per_m_.height(); ++row) {
    for (int column = 0; column < log_px_per_m_.width(); ++column) {
      const Eigen::Vector2d place = kCell_px * centre_of({column, row});
      double weights = params.mean_weight;
      double sum = params.mean_weight * mean;
      for (const ScaleSample& sample : samples) {
        const double apart = (sample.place_in_sketch - place).norm() / params.reach_px;
        const double weight = std::exp(-0.5 * apart * apart);
        weights += weight;
        sum += weight * std::log(sample.px_per_m);
      }
      log_px_per_m_.at({column, row}) = static_cast<float>(sum / weights);
    }
  }
}

Grid<float> ScaleField::m_per_px(int width_px, int height_px) const {
  Grid<float> m_per_px(width_px, height_px, static_cast<float>(1.0 / elsewhere_px_per_m_));
  if (log_px_per_m_.empty()) {
    return m_per_px;
  }
  std::vector<Between> columns;
  for (int column = 0; column < width_px; ++column) {
    columns.push_back(between(column, log_px_per_m_.width()));
  }
  std::vector<double> coarse(static_cast<std::size_t>(log_px_per_m_.width()));
  for (int row = 0; row < height_px; ++row) {
    const Between rows = between(row, log_px_per_m_.height());
    for (int column = 0; column < log_px_per_m_.width(); ++column) {
      coarse[static_cast<std::size_t>(column)] =
          std::lerp(static_cast<double>(log_px_per_m_.at({column, rows.first})),
                    static_cast<double>(log_px_per_m_.at({column, rows.second})), rows.share);
    }
    const std::span<float> out = m_per_px.row(row);
    for (std::size_t column = 0; column < columns.size(); ++column) {
      const Between& at = columns[column];
      const double first = coarse[static_cast<std::size_t>(at.first)];
      const double second = coarse[static_cast<std::size_t>(at.second)];
      out[column] = static_cast<float>(std::exp(-(first + at.share * (second - first))));
    }
  }
  return m_per_px;
}

double ScaleField::px_per_m(const Eigen::Vector2d& place_in_sketch) const {
  if (log_px_per_m_.empty()) {
    return elsewhere_px_per_m_;
  }
  const Eigen::Vector2d cells = place_in_sketch / kCell_px;
  const Eigen::Vector2d inside(std::clamp(cells.x(), 0.5, log_px_per_m_.width() - 0.5),
                               std::clamp(cells.y(), 0.5, log_px_per_m_.height() - 0.5));
  const std::optional<float> value = sample(log_px_per_m_, inside);
  return value ? std::exp(static_cast<double>(*value)) : elsewhere_px_per_m_;
}

}  // namespace sketchloc
