#include "registration/distance_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "motion/check.hpp"

namespace sketchloc {
namespace {

/// Squared distance along the column to its nearest occupied cell; `none` where there is none.
Grid<std::int32_t> squared_column_distances(const Grid<std::uint8_t>& occupied, std::int32_t none) {
  const int height = occupied.height();
  const auto width = static_cast<std::size_t>(occupied.width());
  const std::int32_t far = occupied.height();  // farther than any cell of the column
  Grid<std::int32_t> distances(occupied.width(), height);
  std::vector<std::int32_t> running(width, far);
  for (int row = 0; row < height; ++row) {
    const std::uint8_t* cell = occupied.row(row).data();
    std::int32_t* out = distances.row(row).data();
    for (std::size_t i = 0; i < width; ++i) {
      running[i] = cell[i] != 0 ? 0 : std::min(running[i] + 1, far);
      out[i] = running[i];
    }
  }
  std::fill(running.begin(), running.end(), far);
  for (int row = height - 1; row >= 0; --row) {
    std::int32_t* out = distances.row(row).data();
    for (std::size_t i = 0; i < width; ++i) {
      running[i] = std::min(running[i] + 1, out[i]);
      out[i] = running[i] >= far ? none : running[i] * running[i];
    }
  }
  return distances;
}

/// A parabola of the lower envelope along one row: (x - column)^2 + height, lowest from `from` on.
struct Parabola {
  std::int32_t column;
  std::int32_t height;
  std::int32_t from;

  std::int32_t at(std::int32_t x) const { return (x - column) * (x - column) + height; }
};

/// First column at which `right` lies strictly below `left` [Meijster00 eq. 5]. The quotient of two
/// integers below 2^31 never rounds across an integer in double, so truncation is exact.
std::int32_t first_column_below(const Parabola& left, const Parabola& right) {
  const double rise = right.at(0) - left.at(0);
  return static_cast<std::int32_t>(rise / (2.0 * (right.column - left.column))) + 1;
}

/// The lower envelope of the row's parabolas, left to right; empty where the row has none.
void find_envelope(std::span<const std::int32_t> heights, std::int32_t none,
                   std::vector<Parabola>& envelope) {
  envelope.clear();
  const auto width = static_cast<std::int32_t>(heights.size());
  for (std::int32_t column = 0; column < width; ++column) {
    Parabola next{column, heights[static_cast<std::size_t>(column)], 0};
    if (next.height == none) {
      continue;
    }
    while (!envelope.empty() &&
           next.at(envelope.back().from) < envelope.back().at(envelope.back().from)) {
      envelope.pop_back();
    }
    if (!envelope.empty()) {
      // Not below at the start of the last one, so the quotient is not negative.
      next.from = first_column_below(envelope.back(), next);
    }
    if (next.from < width) {
      envelope.push_back(next);
    }
  }
}

void fill_row(std::span<const Parabola> envelope, std::span<float> distances) {
  for (std::size_t i = 0; i < envelope.size(); ++i) {
    const Parabola& lowest = envelope[i];
    const auto end =
        i + 1 < envelope.size() ? static_cast<std::size_t>(envelope[i + 1].from) : distances.size();
    for (auto x = static_cast<std::size_t>(lowest.from); x < end; ++x) {
      const std::int32_t across = static_cast<std::int32_t>(x) - lowest.column;
      distances[x] = std::sqrt(static_cast<float>(across * across + lowest.height));
    }
  }
}

}  // namespace

Grid<float> distance_field_px(const Grid<std::uint8_t>& occupied) {
  constexpr std::int32_t kNone = std::numeric_limits<std::int32_t>::max();
  const std::int64_t width = occupied.width();
  const std::int64_t height = occupied.height();
  check(width * width + height * height < kNone, "grid too large for squared distances in 32 bit");
  const Grid<std::int32_t> columns = squared_column_distances(occupied, kNone);
  Grid<float> distances(occupied.width(), occupied.height(),
                        std::numeric_limits<float>::infinity());
  std::vector<Parabola> envelope;
  envelope.reserve(static_cast<std::size_t>(width));
  for (int row = 0; row < occupied.height(); ++row) {
    find_envelope(columns.row(row), kNone, envelope);
    fill_row(envelope, distances.row(row));
  }
  return distances;
}

}  // namespace sketchloc
