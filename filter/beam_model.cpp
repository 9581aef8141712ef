#include "filter/beam_model.hpp"

#include <algorithm>
#include <cmath>

#include "motion/validate.hpp"

namespace sketchloc {
namespace {

constexpr double kLeastRangeM = 1e-3;  ///< the robot may stand on its own laser's end point

}  // namespace

void validate(const BeamModelParams& params) {
  validate_part("selection", params.selection);
  validate_part("kernel", params.kernel);
  require_in_range("exponent", params.exponent, 1e-6, 1.0);
}

BeamModel::BeamModel(const RangeTable& table, const BeamModelParams& params)
    : params_((validate(params), params)), kernel_(table, params.kernel) {}

std::size_t BeamModel::observe(const Scan& scan) {
  select_beams(selected_, scan, params_.selection);
  beams_.clear();
  for (const auto& [end, returned] : selected_) {
    beams_.push_back({.bearing_rad = static_cast<float>(std::atan2(end.y(), end.x())),
                      .range_m = static_cast<float>(std::max(end.norm(), kLeastRangeM)),
                      .returned = returned});
  }
  kernel_.prepare(beams_, prepared_);
  return beams_.size();
}

void BeamModel::score(const ParticleSet& particles, const ParticleRange& range,
                      std::span<float> log_likelihood) const {
  const std::size_t count = range.end - range.begin;
  kernel_.score(particles.spans().subspan(range.begin, count), prepared_,
                log_likelihood.subspan(range.begin, count));
}

}  // namespace sketchloc
