#include "registration/detail/range_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <numbers>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "registration/detail/range_sweep.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

#include "registration/detail/simd_math-inl.hpp"

// Shared by all instruction sets.
#ifndef SKETCHLOC_REGISTRATION_RANGE_SWEEP_ONCE
#define SKETCHLOC_REGISTRATION_RANGE_SWEEP_ONCE
namespace sketchloc::detail {

constexpr std::size_t kMargin = 128;  ///< free places beside a column, more than two vectors
constexpr std::uint16_t kNever = std::numeric_limits<std::uint16_t>::max();

/// The drawing turned so that all rays of a quarter turn (32 headings) run from column to column.
/// 0xFFFF where a stroke is; each column has a free margin on both sides.
struct TurnedStrokes {
  int columns = 0;  ///< along the rays, numbered in their direction
  int rows = 0;     ///< across
  std::size_t pitch = 0;
  std::vector<std::uint16_t> cells;

  const std::uint16_t* column(int index) const {
    return cells.data() + static_cast<std::size_t>(index) * pitch + kMargin;
  }
};

/// How a family of lines one pixel apart crosses a column, in units of length along the rays' axis.
/// A line enters at some pixel r; with `step` != 0 it is in pixel r + step after `before` units.
struct Crossing {
  int step = 0;
  std::uint16_t before = 0;
  std::uint16_t after = 0;
  bool centre_in_second = false;  ///< the column's centre line is met in pixel r + step
};

/// Distances from one side of a column, per row, in units: to the next stroke, and the same for a
/// line that starts in a stroke and has to leave it first.
struct Distances {
  std::vector<std::uint16_t> to_stroke_cells;
  std::vector<std::uint16_t> through_cells;

  explicit Distances(std::size_t pitch)
      : to_stroke_cells(pitch, kNever), through_cells(pitch, kNever) {}
  void clear() {
    std::fill(to_stroke_cells.begin(), to_stroke_cells.end(), kNever);
    std::fill(through_cells.begin(), through_cells.end(), kNever);
  }
  std::uint16_t* to_stroke() { return to_stroke_cells.data() + kMargin; }
  std::uint16_t* through() { return through_cells.data() + kMargin; }
};

/// Code of a distance d: log(d) * per_log + at_one, rounded.
struct CodeScale {
  float per_log;
  float at_one;
};

}  // namespace sketchloc::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace sketchloc::detail::HWY_NAMESPACE {
namespace {

using U16 = hn::ScalableTag<std::uint16_t>;

/// Walks back over one column: distances at its entry side from those at its exit side.
void advance(const std::uint16_t* strokes, int rows, const Crossing& crossing,
             const std::uint16_t* next_to_stroke, const std::uint16_t* next_through,
             std::uint16_t* to_stroke, std::uint16_t* through) {
  const U16 d;
  const auto before = hn::Set(d, crossing.before);
  const auto after = hn::Set(d, crossing.after);
  for (int r = 0; r < rows; r += static_cast<int>(hn::Lanes(d))) {
    const int exit = r + crossing.step;
    const auto first = hn::LoadU(d, strokes + r);
    auto beyond = hn::LoadU(d, next_to_stroke + exit);
    auto beyond_through = hn::LoadU(d, next_through + exit);
    if (crossing.step != 0) {
      const auto second = hn::LoadU(d, strokes + exit);
      beyond_through = hn::SaturatedAdd(hn::IfVecThenElse(second, beyond_through, beyond), after);
      beyond = hn::AndNot(second, beyond_through);
    }
    const auto leave = hn::SaturatedAdd(hn::IfVecThenElse(first, beyond_through, beyond), before);
    hn::StoreU(leave, d, through + r);
    hn::StoreU(hn::AndNot(first, leave), d, to_stroke + r);
  }
}

template <class DF, class V = hn::Vec<DF>>
HWY_INLINE void store_codes(DF df, hn::Vec<hn::Rebind<std::uint16_t, DF>> distance,
                            const CodeScale& scale, std::int8_t* codes) {
  const hn::Rebind<std::int32_t, DF> di;
  const hn::Rebind<std::int8_t, DF> d8;
  const auto units = hn::PromoteTo(di, distance);
  const V log = logarithm(df, hn::ConvertTo(df, hn::Max(units, hn::Set(di, 1))));
  const V code = hn::Add(hn::Mul(log, hn::Set(df, scale.per_log)), hn::Set(df, scale.at_one));
  const auto rounded = hn::NearestInt(hn::Min(code, hn::Set(df, 127.0F)));
  const auto never = hn::Eq(units, hn::Set(di, kNever));
  hn::StoreU(hn::DemoteTo(d8, hn::IfThenElse(never, hn::Set(di, 127), rounded)), d8, codes);
}

/// Codes at the centre line of a column from the distances at its entry side: half a unit less.
void encode_from_entry(const std::uint16_t* through, int rows, std::uint16_t half,
                       const CodeScale& scale, std::int8_t* codes) {
  const hn::ScalableTag<float> df;
  const hn::Rebind<std::uint16_t, decltype(df)> d;
  const auto never = hn::Set(d, kNever);
  for (int r = 0; r < rows; r += static_cast<int>(hn::Lanes(df))) {
    const auto distance = hn::LoadU(d, through + r);
    const auto shorter = hn::Sub(distance, hn::Set(d, half));
    store_codes(df, hn::IfThenElse(hn::Eq(distance, never), never, shorter), scale, codes + r);
  }
}

/// The same from the distances at its exit side: half a unit more.
void encode_from_exit(const std::uint16_t* strokes, const std::uint16_t* next_to_stroke,
                      const std::uint16_t* next_through, int rows, std::uint16_t half,
                      const CodeScale& scale, std::int8_t* codes) {
  const hn::ScalableTag<float> df;
  const hn::Rebind<std::uint16_t, decltype(df)> d;
  for (int r = 0; r < rows; r += static_cast<int>(hn::Lanes(df))) {
    const auto beyond = hn::IfVecThenElse(hn::LoadU(d, strokes + r), hn::LoadU(d, next_through + r),
                                          hn::LoadU(d, next_to_stroke + r));
    store_codes(df, hn::SaturatedAdd(beyond, hn::Set(d, half)), scale, codes + r);
  }
}

/// 16 planes of one heading each -> 16 bytes side by side per cell: planes[h * plane + i] goes to
/// out[i * stride + h].
void interleave(const std::int8_t* planes, std::size_t plane, std::size_t count, std::int8_t* out,
                std::size_t stride) {
  std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
  const hn::Full128<std::int8_t> d8;
  using V = hn::Vec<decltype(d8)>;
  // One round: every pair (k, k + 8) becomes its two interleaved halves (2k, 2k + 1).
  // Four such rounds rotate the eight bits of a byte's place (plane, cell) by four: a
  // transposition.
  const auto round = [d8](const V(&in)[16], V(&shuffled)[16]) HWY_ATTR {
    for (std::size_t k = 0; k < 8; ++k) {
      shuffled[2 * k] = hn::InterleaveLower(d8, in[k], in[k + 8]);
      shuffled[2 * k + 1] = hn::InterleaveUpper(d8, in[k], in[k + 8]);
    }
  };
  for (; i + 16 <= count; i += 16) {
    V a[16];
    V b[16];
    for (std::size_t h = 0; h < 16; ++h) {
      a[h] = hn::LoadU(d8, planes + h * plane + i);
    }
    round(a, b);
    round(b, a);
    round(a, b);
    round(b, a);
    for (std::size_t k = 0; k < 16; ++k) {
      hn::StoreU(a[k], d8, out + (i + k) * stride);
    }
  }
#endif
  for (; i < count; ++i) {
    for (std::size_t h = 0; h < 16; ++h) {
      out[i * stride + h] = planes[h * plane + i];
    }
  }
}

}  // namespace
}  // namespace sketchloc::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sketchloc::detail {
namespace {

HWY_EXPORT(advance);
HWY_EXPORT(encode_from_entry);
HWY_EXPORT(encode_from_exit);
HWY_EXPORT(interleave);

constexpr int kHeadings = 128;
constexpr int kPiece = 16;  ///< headings that are swept together and written side by side
constexpr int kPhases = 4;  ///< families of lines per heading, a quarter of a pixel apart

TurnedStrokes turn(const Grid<std::uint8_t>& occupied, bool along_x) {
  TurnedStrokes strokes;
  strokes.columns = along_x ? occupied.width() : occupied.height();
  strokes.rows = along_x ? occupied.height() : occupied.width();
  strokes.pitch = static_cast<std::size_t>(strokes.rows) + 2 * kMargin;
  strokes.cells.assign(strokes.pitch * static_cast<std::size_t>(strokes.columns), 0);
  const std::size_t step_x = along_x ? strokes.pitch : 1;
  const std::size_t step_y = along_x ? 1 : strokes.pitch;
  for (int y = 0; y < occupied.height(); ++y) {
    std::uint16_t* out = strokes.cells.data() + kMargin + static_cast<std::size_t>(y) * step_y;
    for (const std::uint8_t cell : occupied.row(y)) {
      *out = cell != 0 ? kNever : 0;
      out += step_x;
    }
  }
  return strokes;
}

/// A direction seen from its axis: rows per column, and whether it runs towards lower columns.
struct Direction {
  bool along_x;
  bool backward;
  double slope;
};

Direction direction_of(int heading) {
  const double angle_rad = heading * (2.0 * std::numbers::pi / kHeadings);
  const double x = std::cos(angle_rad);
  const double y = std::sin(angle_rad);
  const int piece = heading / kPiece;
  const bool along_x = piece == 7 || piece == 0 || piece == 3 || piece == 4;
  const double slope = along_x ? y / std::abs(x) : x / std::abs(y);
  const bool diagonal = heading % 32 == 16;
  return {.along_x = along_x,
          .backward = along_x ? x < 0 : y < 0,
          .slope = diagonal ? std::copysign(1.0, slope) : slope};
}

/// The lines at row = slope * column + offset (+ any whole number) in one column.
Crossing crossing_of(double slope, double offset, int column, int units) {
  const double enter = slope * column + offset;
  const int step = static_cast<int>(std::floor(slope * (column + 1) + offset) - std::floor(enter));
  if (step == 0) {
    return {.before = static_cast<std::uint16_t>(units)};
  }
  const double boundary = std::floor(enter) + (step > 0 ? 1.0 : 0.0);
  const double before = std::clamp((boundary - enter) / slope, 0.0, 1.0);
  const auto before_units = static_cast<int>(std::lround(before * units));
  return {.step = step,
          .before = static_cast<std::uint16_t>(before_units),
          .after = static_cast<std::uint16_t>(units - before_units),
          .centre_in_second = before < 0.5};
}

/// Which pixels answer for cells: the central one of each block of `cell_px`.
struct Sampling {
  int cell_px;
  int size_px;

  int count() const { return (size_px + cell_px - 1) / cell_px; }
  int pixel(int cell) const { return std::min(cell * cell_px + cell_px / 2, size_px - 1); }
  bool holds(int pixel_index) const { return pixel(pixel_index / cell_px) == pixel_index; }
};

/// Walks one heading after the other through the drawing, into planes of codes.
class Sweep {
 public:
  Sweep(const TurnedStrokes& strokes, const RangeScale& scale, int cell_px)
      : strokes_(strokes),
        scale_(scale),
        along_{cell_px, strokes.columns},
        across_{cell_px, strokes.rows},
        full_row_(strokes.pitch) {
    // The finest unit in which the longest way still fits 16 bits.
    while (units_ > 2 && units_ * (strokes.columns + 1) >= kNever) {
      units_ /= 2;
    }
    for (int phase = 0; phase < kPhases; ++phase) {
      here_.emplace_back(strokes.pitch);
      beyond_.emplace_back(strokes.pitch);
    }
  }

  std::size_t plane_pitch() const { return static_cast<std::size_t>(across_.count()) + kMargin; }
  std::size_t plane_size() const {
    return plane_pitch() * static_cast<std::size_t>(along_.count());
  }

  /// Codes of one heading, [cell along][cell across], with `plane_pitch()` bytes per row.
  void walk(const Direction& direction, std::int8_t* plane) {
    const double per_unit_px = std::hypot(1.0, direction.slope) / units_;
    const CodeScale code{
        .per_log = static_cast<float>(1.0 / scale_.log_step),
        .at_one = static_cast<float>(std::log(per_unit_px / scale_.min_range_px) / scale_.log_step -
                                     128.0)};
    for (int phase = 0; phase < kPhases; ++phase) {
      beyond_[static_cast<std::size_t>(phase)].clear();
    }
    for (int column = strokes_.columns - 1; column >= 0; --column) {
      const int pixel = direction.backward ? strokes_.columns - 1 - column : column;
      const std::uint16_t* strokes = strokes_.column(pixel);
      step_back(strokes, direction.slope, column);
      if (along_.holds(pixel)) {
        const auto row = static_cast<std::size_t>(pixel / along_.cell_px) * plane_pitch();
        encode(strokes, direction.slope, column, code, plane + row);
      }
      std::swap(here_, beyond_);
    }
  }

 private:
  static double offset_of(int phase) { return (phase + 0.5) / kPhases; }

  void step_back(const std::uint16_t* strokes, double slope, int column) {
    for (int phase = 0; phase < kPhases; ++phase) {
      Distances& here = here_[static_cast<std::size_t>(phase)];
      Distances& beyond = beyond_[static_cast<std::size_t>(phase)];
      const Crossing crossing = crossing_of(slope, offset_of(phase), column, units_);
      HWY_DYNAMIC_DISPATCH(advance)
      (strokes, strokes_.rows, crossing, beyond.to_stroke(), beyond.through(), here.to_stroke(),
       here.through());
    }
  }

  /// Takes the lines that pass the column's centre line nearest to the centres of the pixels.
  void encode(const std::uint16_t* strokes, double slope, int column, const CodeScale& code,
              std::int8_t* out) {
    int nearest = 0;
    double least = 1.0;
    for (int phase = 0; phase < kPhases; ++phase) {
      const double row = slope * (column + 0.5) + offset_of(phase);
      const double off_centre = std::abs(row - std::floor(row) - 0.5);
      if (off_centre < least) {
        least = off_centre;
        nearest = phase;
      }
    }
    Distances& here = here_[static_cast<std::size_t>(nearest)];
    Distances& beyond = beyond_[static_cast<std::size_t>(nearest)];
    const auto half = static_cast<std::uint16_t>(units_ / 2);
    std::int8_t* row = across_.cell_px == 1 ? out : full_row_.data();
    if (crossing_of(slope, offset_of(nearest), column, units_).centre_in_second) {
      HWY_DYNAMIC_DISPATCH(encode_from_exit)
      (strokes, beyond.to_stroke(), beyond.through(), strokes_.rows, half, code, row);
    } else {
      HWY_DYNAMIC_DISPATCH(encode_from_entry)(here.through(), strokes_.rows, half, code, row);
    }
    for (int cell = 0; across_.cell_px > 1 && cell < across_.count(); ++cell) {
      out[cell] = row[across_.pixel(cell)];
    }
  }

  const TurnedStrokes& strokes_;
  RangeScale scale_;
  Sampling along_;
  Sampling across_;
  int units_ = 64;                 ///< per pixel along the axis
  std::vector<Distances> here_;    ///< at the entry side of the current column, per phase
  std::vector<Distances> beyond_;  ///< at its exit side
  std::vector<std::int8_t> full_row_;
};

}  // namespace

void sweep_all_headings(const Grid<std::uint8_t>& occupied, const RangeScale& scale, int cell_px,
                        std::span<std::int8_t> codes) {
  const std::size_t columns = static_cast<std::size_t>(Sampling{cell_px, occupied.width()}.count());
  for (const bool along_x : {true, false}) {
    const TurnedStrokes strokes = turn(occupied, along_x);
    Sweep sweep(strokes, scale, cell_px);
    std::vector<std::int8_t> planes(kPiece * sweep.plane_size());
    const std::size_t along_step = along_x ? kHeadings : columns * kHeadings;
    const std::size_t across_step = along_x ? columns * kHeadings : kHeadings;
    const Sampling along{cell_px, strokes.columns};
    const Sampling across{cell_px, strokes.rows};
    for (int first = 0; first < kHeadings; first += kPiece) {
      if (direction_of(first).along_x != along_x) {
        continue;
      }
      for (int h = 0; h < kPiece; ++h) {
        sweep.walk(direction_of(first + h),
                   planes.data() + static_cast<std::size_t>(h) * sweep.plane_size());
      }
      for (int cell = 0; cell < along.count(); ++cell) {
        const auto i = static_cast<std::size_t>(cell);
        HWY_DYNAMIC_DISPATCH(interleave)
        (planes.data() + i * sweep.plane_pitch(), sweep.plane_size(),
         static_cast<std::size_t>(across.count()),
         codes.data() + i * along_step + static_cast<std::size_t>(first), across_step);
      }
    }
  }
}

}  // namespace sketchloc::detail
#endif
