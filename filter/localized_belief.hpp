#pragma once

#include <optional>

#include "filter/contradiction.hpp"
#include "filter/estimate.hpp"
#include "filter/particle_set.hpp"
#include "motion/state_bytes.hpp"
#include "registration/warp_predictor.hpp"

namespace sketchloc {

/// Log-likelihood ratio of what a step without a registration showed, if the hypothesis is right
/// against if it is wrong: bias + evidence * e, e the log-likelihood per beam of a scan that is all
/// new.
struct SignWeights {
  double bias = 0.0;
  double evidence = 0.0;
};

template <typename Visitor>
void visit_fields(SignWeights& weights, Visitor&& visit) {
  visit("bias", weights.bias);
  visit("evidence", weights.evidence);
}

/// What a registration shows: the sign x = logit(p) + place * v, of its inlier probability p and
/// the log odds v that the verification gives its place. At a right pose it is Gaussian around the
/// drawing's *quality* there, which differs from drawing to drawing and from part to part; at a
/// wrong one it is the same everywhere. A poor sign in a drawing that never gave better ones says
/// little.
struct RegistrationSigns {
  double place = 0.5;
  double quality_mean = 3.9;   ///< over drawings
  double quality_sigma = 0.9;  ///< over drawings, > 0
  double quality_way_m = 100;  ///< after which the quality is another one, > 0
  double right_sigma = 2.5;    ///< around the quality, > 0
  double wrong_mean = -2.0;
  double wrong_sigma = 3.5;  ///< > 0
};

template <typename Visitor>
void visit_fields(RegistrationSigns& signs, Visitor&& visit) {
  visit("place", signs.place);
  visit("quality_mean", signs.quality_mean);
  visit("quality_sigma", signs.quality_sigma);
  visit("quality_way_m", signs.quality_way_m);
  visit("right_sigma", signs.right_sigma);
  visit("wrong_mean", signs.wrong_mean);
  visit("wrong_sigma", signs.wrong_sigma);
}

/// When a pose counts as right, and what tells. The numbers that are not bounds were fitted on
/// simulated drives by docs/results/fit_localized.py (see docs/results/robust.md).
struct LocalizedParams {
  double bound_m = 2.0;             ///< right: the position is within this, local metres, > 0
  double bound_rad = 0.5236;        ///< and the heading within this, in (0, pi]
  double lost_way_m = 60.0;         ///< mean way from being right to being wrong, > 0
  double found_way_m = 50.0;        ///< and back, > 0
  double start_log_odds = 4.0;      ///< of a start that was given
  double anywhere_log_odds = -3.5;  ///< of a pose anywhere in the drawing
  double independent_way_m = 2.0;   ///< after which a scan tells nothing that the last told, > 0
  double max_ratio = 3.9;           ///< the most that one step tells, either way, > 0
  /// Contradiction of two scans at which having been carried is as likely as not.
  double carried_contradiction = 0.1;
  double carried_slope = 100.0;  ///< log odds for a contradiction that is greater by 1, >= 0
  ContradictionParams contradiction{};
  SignWeights beams{.bias = 0.04};  ///< without registrations
  RegistrationSigns registered{};
};

template <typename Visitor>
void visit_fields(LocalizedParams& params, Visitor&& visit) {
  visit("bound_m", params.bound_m);
  visit("bound_rad", params.bound_rad);
  visit("lost_way_m", params.lost_way_m);
  visit("found_way_m", params.found_way_m);
  visit("start_log_odds", params.start_log_odds);
  visit("anywhere_log_odds", params.anywhere_log_odds);
  visit("independent_way_m", params.independent_way_m);
  visit("max_ratio", params.max_ratio);
  visit("carried_contradiction", params.carried_contradiction);
  visit("carried_slope", params.carried_slope);
  visit("contradiction", params.contradiction);
  visit("beams", params.beams);
  visit("registered", params.registered);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const LocalizedParams& params);

/// What a step showed of a hypothesis.
struct LocalizedSigns {
  double way_m = 0.0;      ///< driven since the last signs
  double new_share = 1.0;  ///< of what is seen, as far as the last signs did not know it, [0, 1]
  double evidence = 0.0;   ///< log-likelihood per beam, <= 0; registrations speak for themselves
  std::optional<double> inlier_probability = std::nullopt;  ///< of a registration from there
  double place_log_odds = 0.0;                              ///< of that one, verified
};

/// The quality of the drawing where the robot is, if the hypothesis is right: Gaussian, in standard
/// deviations of quality over drawings from their mean. Plain data.
struct QualityBelief {
  double mean = 0.0;
  double variance = 1.0;
};

/// Whether a hypothesis of the robot's pose is right: a Bayes filter over {right, wrong} and the
/// drawing's quality, with changes by the way driven (docs/filter.md). Plain data.
struct LocalizedBelief {
  double log_odds = 0.0;
  QualityBelief quality{};

  void save(StateWriter& state) const;
  void load(StateReader& state);

  void add(const LocalizedSigns& signs, const LocalizedParams& params);

  /// Two scans in a row contradict each other: the robot may have been carried away.
  void add_contradiction(double contradiction, const LocalizedParams& params);

 private:
  void drive(double way_m, const LocalizedParams& params);
  double hear(double sign, double new_share, const RegistrationSigns& signs);
};

/// The signs of a registration from the hypothesis, or of finding none.
void show(LocalizedSigns& signs, const Registration* registration);

/// The share of the particles' weight within the bounds of the estimate, in [0, 1]; weights are
/// normalised (see normalise).
double share_within_bounds(const ParticleSet& particles, const Sim2& sketch_from_robot,
                           const LocalizedParams& params);

}  // namespace sketchloc
