#include "registration/range_table.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/check.hpp"
#include "motion/validate.hpp"
#include "registration/detail/range_sweep.hpp"

namespace sketchloc {
namespace {

/// The least cell size for which the table fits the budget.
int choose_cell_px(std::int64_t width_px, std::int64_t height_px, double memory_mb) {
  int cell_px = 1;
  const auto memory = [&] {
    const std::int64_t columns = (width_px + cell_px - 1) / cell_px;
    const std::int64_t rows = (height_px + cell_px - 1) / cell_px;
    return static_cast<double>(columns * rows * RangeTable::kHeadings) / 1e6;
  };
  while (cell_px < std::max(width_px, height_px) && memory() > memory_mb) {
    ++cell_px;
  }
  return cell_px;
}

}  // namespace

void validate(const RangeTableParams& params) {
  require_above("min_range_px", params.min_range_px, 0.0);
  // Finer steps do not fit the integers of the beam kernel: a strain of 1.5 in 127 half codes, a
  // scale of 600 px/m in 256 codes; and the codes would end below 290 times the least range.
  require_in_range("log_step", params.log_step, 0.025, 0.1);
  require_above("memory_mb", params.memory_mb, 0.0);
}

RangeTable::RangeTable(const Grid<std::uint8_t>& occupied, const RangeTableParams& params)
    : params_(params), width_px_(occupied.width()), height_px_(occupied.height()) {
  validate(params);
  cell_px_ = choose_cell_px(width_px_, height_px_, params.memory_mb);
  pages_ = detail::HugePages(static_cast<std::size_t>(columns()) *
                             static_cast<std::size_t>(rows()) * kHeadings);
  if (!occupied.empty()) {
    detail::sweep_all_headings(occupied,
                               {.min_range_px = params.min_range_px, .log_step = params.log_step},
                               cell_px_, pages_.bytes());
  }
}

double RangeTable::range_px(std::int8_t code) const {
  return params_.min_range_px * std::exp(params_.log_step * (code - kNearest));
}

double RangeTable::max_range_px() const { return range_px(std::int8_t{kNothing - 1}); }

std::optional<double> RangeTable::range_px(const Eigen::Vector2d& point, double heading_rad) const {
  const Cell cell = cell_at(point / cell_px_);
  if (cell.column < 0 || cell.column >= columns() || cell.row < 0 || cell.row >= rows()) {
    return std::nullopt;
  }
  const auto heading =
      std::lround(heading_rad * (kHeadings / (2.0 * std::numbers::pi))) & (kHeadings - 1);
  const std::ptrdiff_t index = std::ptrdiff_t{cell.row} * columns() + cell.column;
  const std::int8_t code = codes()[static_cast<std::size_t>(index * kHeadings + heading)];
  return code == kNothing ? std::nullopt : std::optional(range_px(code));
}

}  // namespace sketchloc
