// The part of the localizer that knows whether it is right, and finds the robot anew.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "filter/localizer.hpp"

namespace sketchloc {
namespace {

/// Streams of their own, far from those of the other steps.
constexpr std::uint64_t kPick = 1ULL << 40;
constexpr std::uint64_t kTakeOver = 1ULL << 41;

constexpr double kMostOfTheParticles = 0.95;  ///< the tracked pose keeps some

}  // namespace

void Localizer::believe(const std::optional<Sim2>& expected_sketch_from_robot,
                        const Se2& robot_from_next, const StepBudget& budget) {
  way_since_signs_m_ += robot_from_next.translation().norm();
  if (expected_sketch_from_robot) {
    follow_jump(*expected_sketch_from_robot);
  }
  if (registrar_) {
    hear_registrations();
    challenge(robot_from_next, budget);
  } else if (report_.updated) {
    report_.signs = {.way_m = way_since_signs_m_,
                     .new_share = update_share_,
                     .evidence = report_.log_likelihood};
    belief_.add(*report_.signs, params_.localized);
    way_since_signs_m_ = 0.0;
  }
  report_.share_within_bounds =
      share_within_bounds(particles_, report_.estimate.sketch_from_robot, params_.localized);
  report_.localized_probability = report_.share_within_bounds / (1.0 + std::exp(-belief_.log_odds));
  report_.challengers = challengers_.all().size();
}

/// Whether the robot can still be where it was: without a look at the drawing.
void Localizer::compare_scans(const Scan& scan, const Se2& robot_from_next) {
  report_.contradiction = 0.0;
  if (last_scan_from_robot_) {
    last_scan_from_robot_ = *last_scan_from_robot_ * robot_from_next;
    report_.contradiction =
        contradiction(scan, last_scan_, *last_scan_from_robot_, params_.localized.contradiction);
    belief_.add_contradiction(report_.contradiction, params_.localized);
    established_ = established_ && report_.contradiction < params_.localized.carried_contradiction;
    for (Challenger& one : challengers_.all()) {
      one.belief.add_contradiction(report_.contradiction, params_.localized);
    }
  }
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    if (scan.is_return(beam)) {
      last_scan_ = scan;
      last_scan_from_robot_ = Se2();
      return;
    }
  }
}

/// Where the heaviest mode is another one than before, what was known of that one counts.
void Localizer::follow_jump(const Sim2& expected_sketch_from_robot) {
  const Sim2& now = report_.estimate.sketch_from_robot;
  if (challengers_.are_one(now, expected_sketch_from_robot)) {
    return;
  }
  LocalizedBelief belief{.log_odds =
                             std::min(belief_.log_odds, params_.localized.anywhere_log_odds)};
  for (const Challenger& one : challengers_.all()) {
    if (challengers_.are_one(now, one.sketch_from_robot)) {
      belief = one.belief;
    }
  }
  challengers_.add({.sketch_from_robot = expected_sketch_from_robot, .belief = belief_});
  belief_ = belief;
  established_ = false;
  challengers_.tidy(now);
}

/// What the registration from the tracked pose says about it.
void Localizer::hear_registrations() {
  if (!report_.registered || !report_.updated) {
    return;
  }
  const Sim2& now = report_.estimate.sketch_from_robot;
  const Registration* nearest = nullptr;
  double least_px = 0.0;
  for (const Registration& one : registrar_->registrations()) {
    const double away_px =
        std::hypot(one.sketch_from_robot.x() - now.x(), one.sketch_from_robot.y() - now.y());
    if (challengers_.are_one(one.sketch_from_robot, now) &&
        (nearest == nullptr || away_px < least_px)) {
      nearest = &one;
      least_px = away_px;
    }
  }
  report_.signs = {
      .way_m = way_since_signs_m_,
      .new_share = std::min(1.0, way_since_signs_m_ / params_.localized.independent_way_m),
      .evidence = report_.log_likelihood};
  show(*report_.signs, nearest);
  belief_.add(*report_.signs, params_.localized);
  way_since_signs_m_ = 0.0;
}

/// Registers challengers that are due and newcomers; lets the best one take over if it has won.
void Localizer::challenge(const Se2& robot_from_next, const StepBudget& budget) {
  if (params_.challengers.count == 0 || anywhere_.empty()) {
    return;
  }
  challengers_.move(robot_from_next, report_.localized_probability);
  if (!report_.updated || !budget.may_register || !registrar_->sees_anything()) {
    return;
  }
  ask(challengers_.take_due());
  if (const std::size_t count = challengers_.take_newcomers(); count > 0) {
    Rng rng = make_rng(params_.seed, kPick + steps_);
    draw_candidates();
    std::vector<Challenger> newcomers;
    for (const Sim2& pose :
         challengers_.pick(candidates_, count, report_.estimate.sketch_from_robot, rng)) {
      newcomers.push_back({.sketch_from_robot = pose,
                           .belief = {.log_odds = params_.localized.anywhere_log_odds},
                           .way_since_look_m = params_.challengers.independent_way_m});
    }
    ask(std::move(newcomers));
  }
  challengers_.tidy(report_.estimate.sketch_from_robot);
  established_ = established_ || belief_.log_odds >= params_.challengers.established_log_odds;
  const bool contestable = !established_ || belief_.log_odds <= params_.challengers.lost_log_odds;
  if (contestable && challengers_.first_takes_over(belief_.log_odds)) {
    take_over();
  }
}

/// Registers from the poses of some, and puts them into the bank with what that told.
void Localizer::ask(std::vector<Challenger> asked) {
  std::vector<Sim2> priors;
  for (const Challenger& one : asked) {
    priors.push_back(one.sketch_from_robot);
  }
  const auto found = priors.empty() ? std::vector<std::optional<Registration>>()
                                    : registrar_->register_from(priors);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i] || !found[i]->covariance || !found[i]->covariance->allFinite()) {
      continue;  // a warp that folds: nothing is there
    }
    Challenger& one = asked[i];
    LocalizedSigns signs{.way_m = one.way_since_look_m, .new_share = challengers_.new_share(one)};
    show(signs, &*found[i]);
    one.belief.add(signs, params_.localized);
    one.sketch_from_robot = found[i]->sketch_from_robot;
    one.way_since_look_m = 0.0;
    challengers_.add(one);
  }
}

/// The particles become a mixture of both places, by their odds.
void Localizer::take_over() {
  Challenger& best = challengers_.all().front();
  const double share = std::min(kMostOfTheParticles,
                                1.0 / (1.0 + std::exp(belief_.log_odds - best.belief.log_odds)));
  const auto count = static_cast<std::size_t>(share * static_cast<double>(particles_.size()));
  candidates_.resize(std::max<std::size_t>(count, 1));
  Rng rng = make_rng(params_.seed, kTakeOver + steps_);
  draw_around(best.sketch_from_robot, candidates_, {.begin = 0, .end = candidates_.size()}, rng);
  chosen_.resize(candidates_.size());
  std::iota(chosen_.begin(), chosen_.end(), 0U);
  replace_evenly(particles_, candidates_, chosen_, rng);
  const Sim2 before = report_.estimate.sketch_from_robot;
  std::swap(best.belief, belief_);
  best.sketch_from_robot = before;
  normalise(particles_);
  mode_finder_.find(particles_, report_.estimate);
  challengers_.tidy(report_.estimate.sketch_from_robot);
  established_ = false;
  report_.found_anew = true;
}

}  // namespace sketchloc
