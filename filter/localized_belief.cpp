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
constexpr double kMostPlaceLogOdds = 7.0;   ///< nor a verification

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
  require_above("registered.quality_sigma", params.registered.quality_sigma, 0.0);
  require_above("registered.quality_way_m", params.registered.quality_way_m, 0.0);
  require_above("registered.right_sigma", params.registered.right_sigma, 0.0);
  require_above("registered.wrong_sigma", params.registered.wrong_sigma, 0.0);
}

void show(LocalizedSigns& signs, const Registration* registration) {
  signs.inlier_probability = registration != nullptr ? registration->inlier_probability : 0.0;
  signs.place_log_odds =
      registration != nullptr ? registration->place_log_odds.value_or(0.0) : -kMostPlaceLogOdds;
}

void LocalizedBelief::save(StateWriter& state) const {
  state.put(log_odds);
  state.put(quality.mean);
  state.put(quality.variance);
}

void LocalizedBelief::load(StateReader& state) {
  log_odds = state.get_finite();
  quality.mean = state.get_finite();
  quality.variance = state.get_finite();
}

void LocalizedBelief::add(const LocalizedSigns& signs, const LocalizedParams& params) {
  drive(signs.way_m, params);
  double ratio = 0.0;
  if (signs.inlier_probability) {
    const double place = std::clamp(signs.place_log_odds, -kMostPlaceLogOdds, kMostPlaceLogOdds);
    const double sign = log_odds_of(*signs.inlier_probability) + params.registered.place * place;
    ratio = hear(sign, signs.new_share, params.registered);
  } else {
    ratio = signs.new_share * (params.beams.bias + params.beams.evidence * signs.evidence);
  }
  const double most = signs.new_share * params.max_ratio;
  log_odds = std::clamp(log_odds + std::clamp(ratio, -most, most), -kMostLogOdds, kMostLogOdds);
}

/// Being right and the quality after some way. Where the robot is found, the quality is that of any
/// drawing: the two Gaussians become one of their mean and variance.
void LocalizedBelief::drive(double way_m, const LocalizedParams& params) {
  const double right = probability_from(log_odds);
  const double lost = -std::expm1(-way_m / params.lost_way_m);
  const double found = -std::expm1(-way_m / params.found_way_m);
  const double still_right = right * (1.0 - lost);
  const double now_right = still_right + (1.0 - right) * found;
  const double now_wrong = right * lost + (1.0 - right) * (1.0 - found);
  if (now_right > 0.0 && now_wrong > 0.0) {
    log_odds = std::log(now_right / now_wrong);
  }
  const double kept = now_right > 0.0 ? still_right / now_right : 1.0;
  const double memory = std::exp(-way_m / params.registered.quality_way_m);
  const double variance =
      kept * (quality.variance + (1.0 - kept) * quality.mean * quality.mean) + (1.0 - kept);
  quality.mean *= kept * memory;
  quality.variance = 1.0 + (variance - 1.0) * memory * memory;
}

/// The log-likelihood ratio of a sign of which a share is new, so that the likelihoods have that
/// exponent; a right pose's is integrated over the quality, which learns from it.
double LocalizedBelief::hear(double sign, double new_share, const RegistrationSigns& signs) {
  if (new_share <= 0.0) {
    return 0.0;
  }
  const double noise = signs.right_sigma * signs.right_sigma / new_share;
  const double prior = signs.quality_sigma * signs.quality_sigma * quality.variance;
  const double innovation = sign - signs.quality_mean - signs.quality_sigma * quality.mean;
  const double right = -new_share * std::log(signs.right_sigma) - 0.5 * std::log1p(prior / noise) -
                       0.5 * innovation * innovation / (noise + prior);
  const double away = (sign - signs.wrong_mean) / signs.wrong_sigma;
  const double wrong = -new_share * (std::log(signs.wrong_sigma) + 0.5 * away * away);
  const double gain = prior / (noise + prior);
  quality.mean += gain * innovation / signs.quality_sigma;
  quality.variance *= 1.0 - gain;
  return right - wrong;
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
