#include "registration/correlation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "motion/check.hpp"

#ifndef SKETCHLOC_REGISTRATION_CORRELATION_ONCE
#define SKETCHLOC_REGISTRATION_CORRELATION_ONCE
namespace sketchloc {
namespace {

/// Planes with a border of kCorrelationReach cells of zeros: (0, 0) is the first cell inside.
class Bordered {
 public:
  Bordered(int planes, int side, std::span<const float> values)
      : width_(side + 2 * kCorrelationReach),
        values_(static_cast<std::size_t>(planes * width_ * width_), 0.0F) {
    for (int row = 0; row < planes * side; ++row) {
      const int y = row / side * width_ + row % side + kCorrelationReach;
      std::copy_n(values.data() + row * side, side,
                  values_.data() + y * width_ + kCorrelationReach);
    }
  }

  const float* at(int plane, int y, int x) const {
    const int row = plane * width_ + y + kCorrelationReach;
    return values_.data() + row * width_ + x + kCorrelationReach;
  }

 private:
  int width_;  ///< of a row, borders included
  std::vector<float> values_;
};

}  // namespace
}  // namespace sketchloc
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "registration/correlation.cpp"
#include <hwy/foreach_target.h>  // compiles this file once per instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace sketchloc::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kPerSide = 2 * kCorrelationReach + 1;
constexpr int kTogether = 4;  ///< channels that share what is loaded

/// A vector of at most 8 lanes: as sides are multiples of 8, all rows are whole vectors.
using Lanes = hn::CappedTag<float, 8>;

void fill_correlation(const FeatureShape& shape, const float* scan, const Bordered& drawing,
                      float factor, float* result) {
  const Lanes d;
  const int step = static_cast<int>(hn::Lanes(d));
  for (int y = 0; y < shape.side; ++y) {
    for (int dy = -kCorrelationReach; dy <= kCorrelationReach; ++dy) {
      for (int x = 0; x < shape.side; x += step) {
        hn::Vec<Lanes> sum[kPerSide];
        std::fill_n(sum, kPerSide, hn::Zero(d));
        for (int channel = 0; channel < shape.channels; ++channel) {
          const auto here = hn::LoadU(d, scan + (channel * shape.side + y) * shape.side + x);
          const float* there = drawing.at(channel, y + dy, x - kCorrelationReach);
          for (int i = 0; i < kPerSide; ++i) {
            sum[i] = hn::Add(sum[i], hn::Mul(here, hn::LoadU(d, there + i)));
          }
        }
        const int first_shift = (dy + kCorrelationReach) * kPerSide;
        for (int i = 0; i < kPerSide; ++i) {
          float* target = result + ((first_shift + i) * shape.side + y) * shape.side + x;
          hn::StoreU(hn::Mul(sum[i], hn::Set(d, factor)), d, target);
        }
      }
    }
  }
}

/// target(c, y, x) = factor * sum over the shifts of
/// gradient(shift, y + g dy, x + g dx) other(c, y + o dy, x + o dx).
void gather(const FeatureShape& shape, const Bordered& gradient, int g, const Bordered& other,
            int o, float factor, float* target) {
  const Lanes d;
  const int step = static_cast<int>(hn::Lanes(d));
  for (int channel = 0; channel < shape.channels; channel += kTogether) {
    const int together = std::min(kTogether, shape.channels - channel);
    for (int y = 0; y < shape.side; ++y) {
      for (int x = 0; x < shape.side; x += step) {
        hn::Vec<Lanes> sum[kTogether];
        std::fill_n(sum, kTogether, hn::Zero(d));
        for (int shift = 0; shift < kCorrelationShifts; ++shift) {
          const int dy = shift / kPerSide - kCorrelationReach;
          const int dx = shift % kPerSide - kCorrelationReach;
          const auto slope = hn::LoadU(d, gradient.at(shift, y + g * dy, x + g * dx));
          for (int i = 0; i < together; ++i) {
            const auto value = hn::LoadU(d, other.at(channel + i, y + o * dy, x + o * dx));
            sum[i] = hn::Add(sum[i], hn::Mul(slope, value));
          }
        }
        for (int i = 0; i < together; ++i) {
          hn::StoreU(hn::Mul(sum[i], hn::Set(d, factor)), d,
                     target + ((channel + i) * shape.side + y) * shape.side + x);
        }
      }
    }
  }
}

}  // namespace
}  // namespace sketchloc::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace sketchloc {
namespace {

HWY_EXPORT(fill_correlation);
HWY_EXPORT(gather);

void check_sizes(const FeatureShape& shape, std::size_t scan, std::size_t drawing,
                 std::size_t shifts) {
  check(shape.side % 8 == 0, "features come in rows of 8");
  const auto size = static_cast<std::size_t>(shape.size());
  check(scan == size && drawing == size, "a value for each channel and cell");
  check(shifts == static_cast<std::size_t>(kCorrelationShifts * shape.cells()),
        "a value for each shift and cell");
}

float factor_of(const FeatureShape& shape) {
  return 1.0F / std::sqrt(static_cast<float>(shape.channels));
}

}  // namespace

void correlate(const FeatureShape& shape, std::span<const float> scan,
               std::span<const float> drawing, std::span<float> result) {
  check_sizes(shape, scan.size(), drawing.size(), result.size());
  HWY_DYNAMIC_DISPATCH(fill_correlation)
  (shape, scan.data(), Bordered(shape.channels, shape.side, drawing), factor_of(shape),
   result.data());
}

void correlate_backwards(const FeatureShape& shape, std::span<const float> scan,
                         std::span<const float> drawing, std::span<const float> gradient,
                         std::span<float> scan_gradient, std::span<float> drawing_gradient) {
  check_sizes(shape, scan.size(), drawing.size(), gradient.size());
  check_sizes(shape, scan_gradient.size(), drawing_gradient.size(), gradient.size());
  const Bordered slopes(kCorrelationShifts, shape.side, gradient);
  const auto collect = HWY_DYNAMIC_DISPATCH(gather);
  collect(shape, slopes, 0, Bordered(shape.channels, shape.side, drawing), 1, factor_of(shape),
          scan_gradient.data());
  collect(shape, slopes, -1, Bordered(shape.channels, shape.side, scan), -1, factor_of(shape),
          drawing_gradient.data());
}

}  // namespace sketchloc
#endif
