#include "filter/localized_belief.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/angles.hpp"
#include "motion/check.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

constexpr double kLeastProbability = 1e-3;  ///< of an inlier: no registration is surer than this

constexpr double kMostLogOdds = 20.0;  ///< of anything

double log_odds_of(double probability) {
  const double p = std::clamp(probability, kLeastProbability, 1.0 - kLeastProbability);
  return std::log(p / (1.0 - p));
}

double probability_from(double log_odds) { return 1.0 / (1.0 + std::exp(-log_odds)); }

}  // namespace

void validate(const LocalizedParams& params) {
  require_above("bound_m", params.bound_m, 0.0);
  require_in_range("bound_rad", params.bound_rad, 1e-3, std::numbers::pi);
  require_above("lost_way_m", params.lost_way_m, 0.0);
  require_above("found_way_m", params.found_way_m, 0.0);
  require_in_range("start_log_odds", params.start_log_odds, -20.0, 20.0);
  require_in_range("anywhere_log_odds", params.anywhere_log_odds, -20.0, 20.0);
  require_above("independent_way_m", params.independent_way_m, 0.0);
  require_above("max_ratio", params.max_ratio, 0.0);
  require_in_range("carried_contradiction", params.carried_contradiction, 0.0, 1.0);
  require_in_range("carried_slope", params.carried_slope, 0.0, 1000.0);
  validate_part("contradiction", params.contradiction);
}

void LocalizedBelief::save(StateWriter& state) const { state.put(log_odds); }

void LocalizedBelief::load(StateReader& state) { log_odds = state.get_finite(); }

void LocalizedBelief::add(const LocalizedSigns& signs, const LocalizedParams& params) {
  const double right = probability_from(log_odds);
  const double lost = -std::expm1(-signs.way_m / params.lost_way_m);
  const double found = -std::expm1(-signs.way_m / params.found_way_m);
  const double still_right = right * (1.0 - lost) + (1.0 - right) * found;
  const double now_wrong = right * lost + (1.0 - right) * (1.0 - found);
  const SignWeights& weights = signs.inlier_probability ? params.registered : params.beams;
  const double ratio = weights.bias + weights.evidence * signs.evidence +
                       weights.inlier * log_odds_of(signs.inlier_probability.value_or(0.5));
  const double before =
      still_right > 0.0 && now_wrong > 0.0 ? std::log(still_right / now_wrong) : log_odds;
  log_odds =
      std::clamp(before + signs.new_share * std::clamp(ratio, -params.max_ratio, params.max_ratio),
                 -kMostLogOdds, kMostLogOdds);
}

void LocalizedBelief::add_contradiction(double contradiction, const LocalizedParams& params) {
  const double stayed =
      probability_from(params.carried_slope * (params.carried_contradiction - contradiction));
  const double right = probability_from(log_odds) * stayed;
  log_odds = std::max(std::log(right / (1.0 - right)), -kMostLogOdds);
}

double share_within_bounds(const ParticleSet& particles, const Sim2& sketch_from_robot,
                           const LocalizedParams& params) {
  check(particles.size() > 0, "there are particles");
  const double bound_px = params.bound_m * sketch_from_robot.scale();
  double sum = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double dx = particles.x_px[i] - sketch_from_robot.x();
    const double dy = particles.y_px[i] - sketch_from_robot.y();
    if (dx * dx + dy * dy <= bound_px * bound_px &&
        std::abs(wrap_rad(static_cast<double>(particles.heading_rad[i]) -
                          sketch_from_robot.yaw_rad())) <= params.bound_rad) {
      sum += std::exp(static_cast<double>(particles.log_weight[i]));
    }
  }
  return std::min(1.0, sum / static_cast<double>(particles.size()));
}

}  // namespace sketchloc
