#include "filter/beam_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/angles.hpp"
#include "motion/check.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

constexpr int kDifferences = 128;  ///< of codes, from -64 to 63
constexpr double kLargestInteger = 65535.0;

using KernelValues = std::array<double, kDifferences>;  ///< by difference modulo 128

int difference_of(int index) { return index < kDifferences / 2 ? index : index - kDifferences; }

KernelValues tabulate(const BeamKernel::LogKernel& kernel, double log_step) {
  KernelValues values{};
  for (int i = 0; i < kDifferences; ++i) {
    const double value = kernel(difference_of(i) * log_step);
    check(std::isfinite(value), "a beam kernel is finite everywhere");
    values[static_cast<std::size_t>(i)] = value;
  }
  return values;
}

double normal_below(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

BeamKernel::LogKernel returned_kernel(const BeamKernelParams& params) {
  return [params](double d) {
    const double z = d / params.sigma;
    return std::log((1.0 - params.floor) * std::exp(-0.5 * z * z) + params.floor);
  };
}

BeamKernel::LogKernel no_return_kernel(const BeamKernelParams& params) {
  return [params](double d) {
    const double floor = params.no_return_floor;
    return std::log((1.0 - floor) * normal_below(-d / params.sigma) + floor);
  };
}

std::int8_t saturate_byte(double value) {
  return static_cast<std::int8_t>(std::lround(std::clamp(value, -128.0, 127.0)));
}

/// A strain e along its axis takes the direction (cos a, sin a) to (exp(e) cos a, exp(-e) sin a).
std::vector<detail::StrainLevel> strain_levels(double log_step) {
  std::vector<detail::StrainLevel> levels(detail::StrainLevel::kLevels);
  for (std::size_t level = 0; level < levels.size(); ++level) {
    const double longer = std::exp(static_cast<double>(level) * detail::StrainLevel::kStep);
    for (std::size_t bin = 0; bin < RangeTable::kHeadings; ++bin) {
      const double angle_rad =
          static_cast<double>(bin) * (2.0 * std::numbers::pi / RangeTable::kHeadings);
      const double along = longer * std::cos(angle_rad);
      const double across = std::sin(angle_rad) / longer;
      const double turn_rad = wrap_rad(std::atan2(across, along) - angle_rad);
      const double stretch = std::log(std::hypot(along, across));
      levels[level].turn[bin] = saturate_byte(turn_rad * (512.0 / (2.0 * std::numbers::pi)));
      levels[level].stretch[bin] = saturate_byte(2.0 * stretch / log_step);
    }
  }
  return levels;
}

std::int16_t saturate(double value) {
  return static_cast<std::int16_t>(std::lround(std::clamp(value, -32768.0, 32767.0)));
}

/// Puts one beam into its place in a group.
void place(const Beam& beam, const RangeTableParams& table, std::size_t index,
           detail::BeamGroup& group) {
  check(beam.range_m > 0.0F && std::isfinite(beam.range_m), "a beam has a positive range");
  check(std::isfinite(beam.bearing_rad) && std::isfinite(beam.log_stretch), "a beam is finite");
  using Group = detail::BeamGroup;
  const double turns = beam.bearing_rad / (2.0 * std::numbers::pi);
  const auto bearing = std::llround((turns - std::floor(turns)) * Group::kTurn);
  const int half_heading = Group::kTurn / RangeTable::kHeadings / 2;
  const double log_range = std::log(beam.range_m) + beam.log_stretch;
  const double code =
      (log_range - std::log(table.min_range_px)) / table.log_step + RangeTable::kNearest;
  group.bearing[index % 2][index / 2] = static_cast<std::uint16_t>(bearing + half_heading);
  group.range[index % 2][index / 2] = saturate((code + 0.5) * Group::kUnitsPerCode);
  group.valid[index] = 0xFF;
  group.no_return[index] = beam.returned ? 0 : 0xFF;
  group.all_returned = group.all_returned && beam.returned;
}

}  // namespace

void validate(const BeamKernelParams& params) {
  require_above("sigma", params.sigma, 0.0);
  require_above("floor", params.floor, 0.0);
  require_in_range("floor", params.floor, 0.0, 1.0);
  require_above("no_return_floor", params.no_return_floor, 0.0);
  require_in_range("no_return_floor", params.no_return_floor, 0.0, 1.0);
}

BeamKernel::BeamKernel(const RangeTable& table, const BeamKernelParams& params)
    : BeamKernel(table, (validate(params), returned_kernel(params)), no_return_kernel(params),
                 params.nothing_drawn) {}

BeamKernel::BeamKernel(const RangeTable& table, const LogKernel& returned,
                       const LogKernel& not_returned, std::optional<double> nothing_drawn)
    : table_(&table), strain_(strain_levels(table.params().log_step)) {
  const KernelValues values = tabulate(returned, table.params().log_step);
  const KernelValues no_return_values = tabulate(not_returned, table.params().log_step);
  const double nothing = nothing_drawn.value_or(values[0]);
  least_ = std::min({std::ranges::min(values), std::ranges::min(no_return_values), nothing});
  const double most =
      std::max({std::ranges::max(values), std::ranges::max(no_return_values), nothing});
  unit_ = std::max(most - least_, 1e-300) / kLargestInteger;
  const auto integer = [this](double value) {
    return static_cast<std::uint16_t>(std::lround((value - least_) / unit_));
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    kernels_.low[i] = static_cast<std::uint8_t>(integer(values[i]) & 0xFF);
    kernels_.high[i] = static_cast<std::uint8_t>(integer(values[i]) >> 8);
    kernels_.no_return_low[i] = static_cast<std::uint8_t>(integer(no_return_values[i]) & 0xFF);
    kernels_.no_return_high[i] = static_cast<std::uint8_t>(integer(no_return_values[i]) >> 8);
  }
  kernels_.nothing = integer(nothing);
  kernels_.has_nothing = nothing_drawn.has_value();
}

void BeamKernel::prepare(std::span<const Beam> beams, PreparedBeams& prepared) const {
  constexpr std::size_t kBeams = detail::BeamGroup::kBeams;
  prepared.beams_ = beams.size();
  prepared.groups_.assign((beams.size() + kBeams - 1) / kBeams, detail::BeamGroup{});
  for (std::size_t i = 0; i < prepared.groups_.size(); ++i) {
    prepared.groups_[i].all_valid = (i + 1) * kBeams <= beams.size();
    prepared.groups_[i].all_returned = true;
  }
  std::size_t next = 0;
  for (const bool returned : {true, false}) {  // so that at most one group holds both kinds
    for (const Beam& beam : beams) {
      if (beam.returned == returned) {
        place(beam, table_->params(), next % kBeams, prepared.groups_[next / kBeams]);
        ++next;
      }
    }
  }
}

void BeamKernel::score(const ParticleSpans& particles, const PreparedBeams& beams,
                       std::span<float> log_likelihood) const {
  check_lengths(particles);
  check(log_likelihood.size() == particles.size(), "one log-likelihood per particle");
  const detail::RangeCodes range{.codes = table_->codes().data(),
                                 .columns = table_->columns(),
                                 .rows = table_->rows(),
                                 .width_px = static_cast<float>(table_->width_px()),
                                 .height_px = static_cast<float>(table_->height_px()),
                                 .cells_per_px = 1.0F / static_cast<float>(table_->cell_px()),
                                 .log_step = static_cast<float>(table_->params().log_step)};
  const detail::BeamTables tables{.range = range, .kernels = &kernels_, .strain = strain_.data()};
  detail::score_beams(particles, tables, beams.groups_,
                      {.unit = unit_, .least = static_cast<double>(beams.size()) * least_},
                      log_likelihood);
}

}  // namespace sketchloc
