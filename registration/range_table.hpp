#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>

#include "datasets/grid.hpp"
#include "registration/detail/huge_pages.hpp"

namespace sketchloc {

/// How ranges are kept in one byte each.
struct RangeTableParams {
  double min_range_px = 0.5;  ///< the least range there is, > 0; nearer ones count as this
  double log_step = 0.03;     ///< of log(range) between two codes, in [0.025, 0.1]
  double memory_mb = 160.0;   ///< budget; a larger drawing gets coarser cells, > 0
};

template <typename Visitor>
void visit_fields(RangeTableParams& params, Visitor&& visit) {
  visit("min_range_px", params.min_range_px);
  visit("log_step", params.log_step);
  visit("memory_mb", params.memory_mb);
}

void validate(const RangeTableParams& params);

/// The range to the first stroke from everywhere in a drawing in 128 directions, one byte each.
///
/// The 128 directions of a cell lie side by side (two cache lines), so that all beams of a particle
/// read the same lines. A cell is `cell_px` x `cell_px` pixels and answers for its central pixel.
///
/// What a byte says: the exact range of a ray which starts at most 1/8 px beside the centre of that
/// pixel (above or below for headings within 45 deg of the x axis, else left or right) to the
/// boundary of the first occupied pixel, rounded to the codes' logarithmic scale. No stroke is
/// ever jumped, not even one connected over corners only. From within a stroke the ray first leaves
/// it and goes on to the next one: people draw doors shut, and a robot that drives through such a
/// line sees what is behind it on either side.
class RangeTable {
 public:
  static constexpr int kHeadings = 128;
  static constexpr std::int8_t kNearest = -128;  ///< code of `min_range_px`
  static constexpr std::int8_t kNothing = 127;   ///< code of "no stroke as far as the codes reach"

  explicit RangeTable(const Grid<std::uint8_t>& occupied, const RangeTableParams& params = {});

  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }
  int cell_px() const { return cell_px_; }
  int columns() const { return (width_px_ + cell_px_ - 1) / cell_px_; }
  int rows() const { return (height_px_ + cell_px_ - 1) / cell_px_; }
  const RangeTableParams& params() const { return params_; }

  /// Every code: [row][column][heading], heading i at i * 2 pi / 128 rad, 64-byte aligned.
  std::span<const std::int8_t> codes() const { return pages_.bytes(); }

  /// The range that a code stands for; the scale between codes is logarithmic.
  double range_px(std::int8_t code) const;

  /// The largest range that has a code; beyond it there is nothing.
  double max_range_px() const;

  /// Range from a point in the sketch frame, to the nearest of the 128 headings; none outside the
  /// drawing and where no stroke is in reach.
  std::optional<double> range_px(const Eigen::Vector2d& point, double heading_rad) const;

 private:
  RangeTableParams params_;
  int width_px_ = 0;
  int height_px_ = 0;
  int cell_px_ = 1;
  detail::HugePages pages_;
};

}  // namespace sketchloc
