#include "filter/beam_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

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
    : BeamKernel(table, (validate(params), returned_kernel(params)), no_return_kernel(params)) {}

BeamKernel::BeamKernel(const RangeTable& table, const LogKernel& returned,
                       const LogKernel& not_returned)
    : table_(&table) {
  const KernelValues values = tabulate(returned, table.params().log_step);
  const KernelValues no_return_values = tabulate(not_returned, table.params().log_step);
  least_ = std::min(std::ranges::min(values), std::ranges::min(no_return_values));
  const double most = std::max(std::ranges::max(values), std::ranges::max(no_return_values));
  unit_ = std::max(most - least_, 1e-300) / kLargestInteger;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto integer = std::lround((values[i] - least_) / unit_);
    const auto no_return_integer = std::lround((no_return_values[i] - least_) / unit_);
    kernels_.low[i] = static_cast<std::uint8_t>(integer & 0xFF);
    kernels_.high[i] = static_cast<std::uint8_t>(integer >> 8);
    kernels_.no_return_low[i] = static_cast<std::uint8_t>(no_return_integer & 0xFF);
    kernels_.no_return_high[i] = static_cast<std::uint8_t>(no_return_integer >> 8);
  }
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

void BeamKernel::score(const ParticleView& particles, const PreparedBeams& beams,
                       std::span<float> log_likelihood) const {
  const std::size_t count = particles.size();
  check(particles.y_px.size() == count && particles.heading_rad.size() == count &&
            particles.scale_px_per_m.size() == count && log_likelihood.size() == count,
        "all arrays of the particles have one length");
  const detail::RangeCodes table{.codes = table_->codes().data(),
                                 .columns = table_->columns(),
                                 .rows = table_->rows(),
                                 .width_px = static_cast<float>(table_->width_px()),
                                 .height_px = static_cast<float>(table_->height_px()),
                                 .cells_per_px = 1.0F / static_cast<float>(table_->cell_px()),
                                 .log_step = static_cast<float>(table_->params().log_step)};
  detail::score_beams(particles, table, kernels_, beams.groups_,
                      {.unit = unit_, .least = static_cast<double>(beams.size()) * least_},
                      log_likelihood);
}

}  // namespace sketchloc
