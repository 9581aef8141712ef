#include "topology/heading_drift.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "motion/angles.hpp"
#include "motion/check.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

/// Histories that agree in so many last turns have the same future.
constexpr int kAgreeing = 4;
/// Passes of the smoother, each with the probabilities of the last.
constexpr int kSmoothingPasses = 4;

double squared(double value) { return value * value; }

struct AxisLikelihood {
  double log_density = 0.0;
  double on_axis = 1.0;  ///< probability
};

/// Of a piece that is `innovation_rad` off where a wall should be.
AxisLikelihood axis_likelihood(double innovation_rad, double variance, const DriftParams& params) {
  const double on_variance = variance + squared(rad_from_deg(params.axis_sigma_deg));
  const double off_variance = variance + squared(rad_from_deg(params.skew_sigma_deg));
  const double on = std::log(1.0 - params.skew_share) -
                    0.5 * (squared(innovation_rad) / on_variance + std::log(on_variance));
  const double off = std::log(params.skew_share) -
                     0.5 * (squared(innovation_rad) / off_variance + std::log(off_variance));
  const double higher = std::max(on, off);
  const double log_density = higher + std::log(std::exp(on - higher) + std::exp(off - higher));
  return {.log_density = log_density, .on_axis = std::exp(on - log_density)};
}

/// What a piece measures, as the Gaussian of the same information.
double measured_variance(double on_axis, const DriftParams& params) {
  return 1.0 / (on_axis / squared(rad_from_deg(params.axis_sigma_deg)) +
                (1.0 - on_axis) / squared(rad_from_deg(params.skew_sigma_deg)));
}

Eigen::Matrix2d transition(double way_m) {
  return (Eigen::Matrix2d() << 1.0, way_m, 0.0, 1.0).finished();
}

/// From the middle of one piece to that of the next.
Eigen::Matrix2d process_noise(const StraightPiece& from, const StraightPiece& to,
                              const DriftParams& params) {
  const double way_m = to.way_m - from.way_m;
  const double quarters = std::abs(to.axis_rad - from.axis_rad) / (0.5 * std::numbers::pi);
  const double walk = squared(rad_from_deg(params.slope_walk_deg));
  Eigen::Matrix2d noise;
  noise(0, 0) = squared(rad_from_deg(params.wander_deg)) * way_m +
                squared(rad_from_deg(params.turn_error_deg)) * quarters +
                walk * way_m * way_m * way_m / 3.0;
  noise(0, 1) = noise(1, 0) = 0.5 * walk * way_m * way_m;
  noise(1, 1) = walk * way_m;
  return noise;
}

}  // namespace

void validate(const DriftParams& params) {
  require_above("wander_deg", params.wander_deg, 0.0);
  require_at_least("turn_error_deg", params.turn_error_deg, 0.0);
  require_above("slope_deg_per_m", params.slope_deg_per_m, 0.0);
  require_above("slope_walk_deg", params.slope_walk_deg, 0.0);
  require_above("axis_sigma_deg", params.axis_sigma_deg, 0.0);
  require_in_range("skew_share", params.skew_share, 1e-6, 1.0 - 1e-6);
  require_above("skew_sigma_deg", params.skew_sigma_deg, params.axis_sigma_deg);
  require_in_range("hypotheses", params.hypotheses, 1.0, 1e5);
}

DriftTracker::DriftTracker(const DriftParams& params) : params_(params) { validate(params); }

DriftTracker::State DriftTracker::predicted(const State& state, std::size_t piece) const {
  const StraightPiece& from = pieces_[piece - 1];
  const StraightPiece& to = pieces_[piece];
  const Eigen::Matrix2d step = transition(to.way_m - from.way_m);
  return {
      .mean = step * state.mean,
      .covariance = step * state.covariance * step.transpose() + process_noise(from, to, params_)};
}

DriftTracker::Hypothesis DriftTracker::extended(const Hypothesis& hypothesis, const State& prior,
                                                int quarter_turns) {
  const double innovation_rad = pieces_.back().axis_rad - angle_rad(quarter_turns) - prior.mean[0];
  const AxisLikelihood likelihood =
      axis_likelihood(innovation_rad, prior.covariance(0, 0), params_);
  const double variance = prior.covariance(0, 0) + measured_variance(likelihood.on_axis, params_);
  const Eigen::Vector2d gain = prior.covariance.col(0) / variance;
  decisions_.push_back({.before = hypothesis.decision,
                        .quarter_turns = quarter_turns,
                        .on_axis = likelihood.on_axis});
  return {.log_weight = hypothesis.log_weight + likelihood.log_density,
          .state = {.mean = prior.mean + gain * innovation_rad,
                    .covariance = prior.covariance - gain * prior.covariance.row(0)},
          .decision = decisions_.size() - 1};
}

void DriftTracker::add(const StraightPiece& piece) {
  check(pieces_.empty() || piece.way_m > pieces_.back().way_m, "pieces in the order of the way");
  pieces_.push_back(piece);
  if (pieces_.size() == 1) {
    const int quarter_turns = nearest_quarter_turns(piece.axis_rad);
    decisions_.push_back({.before = 0, .quarter_turns = quarter_turns});
    State state;
    state.mean[0] = piece.axis_rad - angle_rad(quarter_turns);
    state.covariance(0, 0) = squared(rad_from_deg(params_.axis_sigma_deg));
    state.covariance(1, 1) = squared(rad_from_deg(params_.slope_deg_per_m));
    hypotheses_ = {{.log_weight = 0.0, .state = state, .decision = 0}};
    return;
  }
  std::vector<Hypothesis> candidates;
  for (const Hypothesis& hypothesis : hypotheses_) {
    const State prior = predicted(hypothesis.state, pieces_.size() - 1);
    const int nearest = nearest_quarter_turns(piece.axis_rad - prior.mean[0]);
    for (const int quarter_turns : {nearest - 1, nearest, nearest + 1}) {
      candidates.push_back(extended(hypothesis, prior, quarter_turns));
    }
  }
  keep_the_likeliest(std::move(candidates));
}

bool DriftTracker::agree_lately(std::size_t a, std::size_t b) const {
  for (int i = 0; i < kAgreeing && a != b; ++i) {
    if (decisions_[a].quarter_turns != decisions_[b].quarter_turns) {
      return false;
    }
    a = decisions_[a].before;
    b = decisions_[b].before;
  }
  return true;
}

void DriftTracker::keep_the_likeliest(std::vector<Hypothesis> candidates) {
  std::ranges::stable_sort(candidates, std::greater<>(), &Hypothesis::log_weight);
  const double best = candidates.front().log_weight;
  log_evidence_ += best;
  hypotheses_.clear();
  for (Hypothesis& candidate : candidates) {
    const bool is_new = std::ranges::none_of(hypotheses_, [&](const Hypothesis& kept) {
      return agree_lately(kept.decision, candidate.decision);
    });
    if (is_new) {
      candidate.log_weight -= best;
      hypotheses_.push_back(candidate);
    }
    if (hypotheses_.size() == static_cast<std::size_t>(params_.hypotheses)) {
      break;
    }
  }
}

std::vector<DriftTracker::Decision> DriftTracker::history(std::size_t decision) const {
  std::vector<Decision> decisions(pieces_.size());
  for (auto place = decisions.rbegin(); place != decisions.rend(); ++place) {
    *place = decisions_[decision];
    decision = place->before;
  }
  return decisions;
}

/// Rauch-Tung-Striebel over the decided turns; the probabilities of pieces to run along walls are
/// those of the smoothed drift of the pass before.
void DriftTracker::smooth(std::vector<PieceHeading>& headings) const {
  std::vector<State> priors(headings.size());
  std::vector<State> filtered(headings.size());
  for (std::size_t i = 0; i < headings.size(); ++i) {
    if (i == 0) {
      priors[0].mean[0] = pieces_[0].axis_rad - angle_rad(headings[0].quarter_turns);
      priors[0].covariance(0, 0) = squared(rad_from_deg(45.0));
      priors[0].covariance(1, 1) = squared(rad_from_deg(params_.slope_deg_per_m));
    } else {
      priors[i] = predicted(filtered[i - 1], i);
    }
    const double innovation_rad =
        pieces_[i].axis_rad - angle_rad(headings[i].quarter_turns) - priors[i].mean[0];
    const Eigen::Vector2d gain =
        priors[i].covariance.col(0) /
        (priors[i].covariance(0, 0) + measured_variance(headings[i].on_axis, params_));
    filtered[i].mean = priors[i].mean + gain * innovation_rad;
    filtered[i].covariance = priors[i].covariance - gain * priors[i].covariance.row(0);
  }
  State smoothed = filtered.back();
  for (std::size_t i = headings.size(); i-- > 0;) {
    if (i + 1 < headings.size()) {
      const Eigen::Matrix2d step = transition(pieces_[i + 1].way_m - pieces_[i].way_m);
      const Eigen::Matrix2d gain =
          filtered[i].covariance * step.transpose() * priors[i + 1].covariance.inverse();
      smoothed.mean = filtered[i].mean + gain * (smoothed.mean - priors[i + 1].mean);
      smoothed.covariance =
          filtered[i].covariance +
          gain * (smoothed.covariance - priors[i + 1].covariance) * gain.transpose();
    }
    headings[i].drift_rad = smoothed.mean[0];
    const double residual_rad =
        pieces_[i].axis_rad - angle_rad(headings[i].quarter_turns) - smoothed.mean[0];
    headings[i].on_axis = axis_likelihood(residual_rad, smoothed.covariance(0, 0), params_).on_axis;
  }
}

std::vector<PieceHeading> DriftTracker::headings() const {
  std::vector<PieceHeading> headings;
  if (pieces_.empty()) {
    return headings;
  }
  for (const Decision& decision : history(hypotheses_.front().decision)) {
    headings.push_back({.quarter_turns = decision.quarter_turns, .on_axis = decision.on_axis});
  }
  for (int pass = 0; pass < kSmoothingPasses; ++pass) {
    smooth(headings);
  }
  return headings;
}

std::vector<DriftTracker> drift_trackers(const DriftParams& params) {
  std::vector<DriftTracker> trackers;
  for (const double factor : {1.0, 2.0, 4.0}) {
    DriftParams noisier = params;
    noisier.wander_deg *= factor;
    noisier.turn_error_deg *= factor;
    trackers.emplace_back(noisier);
  }
  return trackers;
}

const DriftTracker& likeliest(std::span<const DriftTracker> trackers) {
  return *std::ranges::max_element(trackers, {}, &DriftTracker::log_evidence);
}

double DriftTracker::log_odds() const {
  return hypotheses_.size() < 2 ? std::numeric_limits<double>::infinity()
                                : hypotheses_[0].log_weight - hypotheses_[1].log_weight;
}

namespace {

template <typename DriftOf>
std::vector<double> interpolated(const Travel& travel, std::span<const StraightPiece> pieces,
                                 const DriftOf& drift_of) {
  std::vector<double> drift(travel.way_m.size(), 0.0);
  if (pieces.empty()) {
    return drift;
  }
  std::size_t after = 0;  // the first piece beyond the pose
  for (std::size_t i = 0; i < drift.size(); ++i) {
    while (after < pieces.size() && pieces[after].way_m <= travel.way_m[i]) {
      ++after;
    }
    if (after == 0 || after == pieces.size()) {
      drift[i] = drift_of(after == 0 ? 0 : after - 1);
      continue;
    }
    const double share = (travel.way_m[i] - pieces[after - 1].way_m) /
                         (pieces[after].way_m - pieces[after - 1].way_m);
    drift[i] = (1.0 - share) * drift_of(after - 1) + share * drift_of(after);
  }
  return drift;
}

}  // namespace

std::vector<double> drift_at_poses(const Travel& travel, std::span<const StraightPiece> pieces,
                                   std::span<const PieceHeading> headings) {
  check(pieces.size() == headings.size(), "one heading for each piece");
  return interpolated(travel, pieces,
                      [headings](std::size_t piece) { return headings[piece].drift_rad; });
}

std::vector<double> snapped_drift_at_poses(const Travel& travel,
                                           std::span<const StraightPiece> pieces,
                                           std::span<const PieceHeading> headings) {
  check(pieces.size() == headings.size(), "one heading for each piece");
  return interpolated(travel, pieces, [pieces, headings](std::size_t piece) {
    return pieces[piece].axis_rad - angle_rad(headings[piece].quarter_turns);
  });
}

}  // namespace sketchloc
