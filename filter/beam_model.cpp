#include "filter/beam_model.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

#include "motion/validate.hpp"

namespace sketchloc {
namespace {

constexpr int kHeadings = RangeTable::kHeadings;
constexpr int kWidest = 255;
constexpr float kBinsPerRad = kHeadings / (2.0F * std::numbers::pi_v<float>);

struct DoubleAngles {
  std::array<float, kHeadings> cosine;
  std::array<float, kHeadings> sine;
};
const DoubleAngles kDouble = [] {
  DoubleAngles t;
  for (int h = 0; h < kHeadings; ++h) {
    t.cosine[static_cast<std::size_t>(h)] =
        static_cast<float>(std::cos(4.0 * std::numbers::pi * h / kHeadings));
    t.sine[static_cast<std::size_t>(h)] =
        static_cast<float>(std::sin(4.0 * std::numbers::pi * h / kHeadings));
  }
  return t;
}();

inline float fast_log(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const float e = static_cast<float>(static_cast<int>(bits >> 23) - 127);
  const float m = std::bit_cast<float>((bits & 0x7fffffU) | 0x3f800000U);
  return 0.6931472F *
         (e + (-1.7417939F +
               (2.8212026F + (-1.4699568F + (0.44717955F - 0.056570851F * m) * m) * m) * m));
}

}  // namespace

void validate(const BeamModelParams& params) {
  validate(params.selection);
  require_above("sigma_log", params.sigma_log, 0.0);
  require_in_range("floor", params.floor, 1e-6, 1.0);
  require_in_range("exponent", params.exponent, 1e-6, 1.0);
  require_at_least("exponent_way_m", params.exponent_way_m, 0.0);
}

BeamModel::BeamModel(const RangeTable& table, const BeamModelParams& params)
    : table_(&table), params_(params) {
  const double step = table.params().log_step;
  for (int d = -kWidest; d <= kWidest; ++d) {
    const double z = d * step / params.sigma_log;
    log_kernel_.push_back(
        static_cast<float>(std::log((1.0 - params.floor) * std::exp(-0.5 * z * z) + params.floor)));
  }
}

void BeamModel::score(const ParticleSet& p, const ParticleRange& range, const BeamSet& beams,
                      std::span<float> log_likelihood) const {
  const float inv_step = static_cast<float>(1.0 / table_->params().log_step);
  const float code_origin = static_cast<float>(
      RangeTable::kNearest - std::log(table_->params().min_range_px) / table_->params().log_step);
  const float nothing = 0.7F * log_kernel_[0];
  std::array<int, kHeadings> shift{};
  std::array<int, kHeadings> longer{};
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const int column =
        static_cast<int>(std::floor(p.x_px[i] / static_cast<float>(table_->cell_px())));
    const int row = static_cast<int>(std::floor(p.y_px[i] / static_cast<float>(table_->cell_px())));
    if (column < 0 || row < 0 || column >= table_->columns() || row >= table_->rows()) {
      log_likelihood[i] = static_cast<float>(beams.size()) * log_kernel_[0];
      continue;
    }
    const std::int8_t* codes =
        table_->codes().data() +
        (static_cast<std::size_t>(row) * static_cast<std::size_t>(table_->columns()) +
         static_cast<std::size_t>(column)) *
            kHeadings;
    const float a = p.axial_strain[i];
    const float b = p.diagonal_strain[i];
    const float r = std::sqrt(a * a + b * b);
    const float ch = std::cosh(r);
    const float sh = r > 1e-6F ? std::sinh(r) / r : 1.0F;
    const float ch2 = std::cosh(2 * r);
    const float sh2 = r > 1e-6F ? std::sinh(2 * r) / r : 2.0F;
    for (std::size_t h = 0; h < kHeadings; ++h) {
      const float along = a * kDouble.cosine[h] + b * kDouble.sine[h];
      const float across = b * kDouble.cosine[h] - a * kDouble.sine[h];
      const float t = sh * across / (ch + sh * along);
      const float turn = t * (1.0F - t * t * (0.3333F - 0.14F * t * t));
      shift[h] = static_cast<int>(std::lrint(turn * kBinsPerRad));
      longer[h] = static_cast<int>(std::lrint(0.5F * fast_log(ch2 + sh2 * along) * inv_step));
    }
    float sum = 0.0F;
    const float code_scale = code_origin + p.log_scale[i] * inv_step;
    for (std::size_t k = 0; k < beams.size(); ++k) {
      const auto h0 = static_cast<std::size_t>(
          static_cast<int>(std::lrint((p.heading_rad[i] + beams.bearing_rad[k]) * kBinsPerRad)) &
          (kHeadings - 1));
      const auto h = static_cast<std::size_t>((static_cast<int>(h0) + shift[h0]) & (kHeadings - 1));
      const std::int8_t e = codes[h];
      if (e == RangeTable::kNothing) {
        sum += nothing;
        continue;
      }
      const int d =
          static_cast<int>(std::lrint(beams.log_range[k] * inv_step + code_scale)) + longer[h0] - e;
      sum += log_kernel_[static_cast<std::size_t>(std::clamp(d, -kWidest, kWidest) + kWidest)];
    }
    log_likelihood[i] = sum;
  }
}

}  // namespace sketchloc
