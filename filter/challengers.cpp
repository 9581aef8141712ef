#include "filter/challengers.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "filter/resample.hpp"
#include "motion/angles.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

constexpr std::size_t kDrawsPerNewcomer = 8;  ///< most of them are not apart

}  // namespace

void validate(const ChallengerParams& params) {
  require_in_range("count", params.count, 0, 64);
  require_above("way_m", params.way_m, 0.0);
  require_above("independent_way_m", params.independent_way_m, 0.0);
  require_at_least("lost_priors_per_m", params.lost_priors_per_m, 0.0);
  require_at_least("calm_priors_per_m", params.calm_priors_per_m, 0.0);
  require_in_range("max_priors", params.max_priors, 1, 64);
  require_in_range("keep_log_odds", params.keep_log_odds, -20.0, 20.0);
  require_in_range("established_log_odds", params.established_log_odds, -20.0, 20.0);
  require_in_range("lost_log_odds", params.lost_log_odds, -20.0, 20.0);
  require_at_least("take_over_log_odds", params.take_over_log_odds, 0.0);
  require_in_range("take_over_probability", params.take_over_probability, 0.0, 1.0);
  require_above("apart_m", params.apart_m, 0.0);
  require_above("apart_rad", params.apart_rad, 0.0);
}

void Challengers::forget() {
  all_.clear();
  budget_ = 0.0;
}

void Challengers::save(StateWriter& state) const {
  state.put<std::uint64_t>(all_.size());
  for (const Challenger& one : all_) {
    state.put(one.sketch_from_robot);
    one.belief.save(state);
    state.put(one.way_since_look_m);
  }
  state.put(budget_);
}

void Challengers::load(StateReader& state) {
  all_.resize(state.get_count(static_cast<std::size_t>(params_.count) + 1));
  for (Challenger& one : all_) {
    one.sketch_from_robot = state.get_sim2();
    one.belief.load(state);
    one.way_since_look_m = state.get_finite();
  }
  budget_ = state.get_finite();
}

void Challengers::move(const Se2& robot_from_next, double calm) {
  const double way_m = robot_from_next.translation().norm();
  for (Challenger& challenger : all_) {
    challenger.sketch_from_robot = challenger.sketch_from_robot * robot_from_next;
    challenger.way_since_look_m += way_m;
  }
  const double priors_per_m =
      calm * params_.calm_priors_per_m + (1.0 - calm) * params_.lost_priors_per_m;
  budget_ = std::min(budget_ + way_m * priors_per_m, static_cast<double>(params_.max_priors));
}

std::vector<Challenger> Challengers::take_due() {
  std::ranges::stable_sort(all_, {}, &Challenger::way_since_look_m);
  std::vector<Challenger> due;
  while (!all_.empty() && all_.back().way_since_look_m >= params_.way_m &&
         due.size() < static_cast<std::size_t>(params_.max_priors)) {
    due.push_back(all_.back());
    all_.pop_back();
  }
  budget_ = std::max(0.0, budget_ - static_cast<double>(due.size()));
  return due;
}

std::size_t Challengers::take_newcomers() {
  const auto count = static_cast<std::size_t>(budget_);
  budget_ -= static_cast<double>(count);
  return count;
}

std::vector<Sim2> Challengers::pick(const ParticleSet& candidates, std::size_t count,
                                    const Sim2& tracked_sketch_from_robot, Rng& rng) const {
  std::vector<std::uint32_t> drawn(kDrawsPerNewcomer * count);
  if (drawn.empty()) {
    return {};
  }
  systematic_parents(candidates.log_weight, drawn, rng);
  for (std::size_t i = drawn.size(); i > 1; --i) {  // in any order, but for the candidates' own
    std::swap(drawn[i - 1], drawn[static_cast<std::size_t>(uniform(rng) * static_cast<double>(i))]);
  }
  std::vector<Sim2> picked;
  for (const std::uint32_t i : drawn) {
    const Sim2 pose = candidates.sketch_from_robot(i);
    const bool known =
        are_one(pose, tracked_sketch_from_robot) ||
        std::ranges::any_of(picked, [&](const Sim2& one) { return are_one(pose, one); }) ||
        std::ranges::any_of(
            all_, [&](const Challenger& one) { return are_one(pose, one.sketch_from_robot); });
    if (!known && picked.size() < count) {
      picked.push_back(pose);
    }
  }
  return picked;
}

double Challengers::new_share(const Challenger& challenger) const {
  return std::min(1.0, challenger.way_since_look_m / params_.independent_way_m);
}

void Challengers::tidy(const Sim2& tracked_sketch_from_robot) {
  std::ranges::stable_sort(all_, std::greater<>(),
                           [](const Challenger& one) { return one.belief.log_odds; });
  std::vector<Challenger> kept;
  for (const Challenger& one : all_) {
    const bool known = are_one(one.sketch_from_robot, tracked_sketch_from_robot) ||
                       std::ranges::any_of(kept, [&](const Challenger& better) {
                         return are_one(one.sketch_from_robot, better.sketch_from_robot);
                       });
    if (!known && one.belief.log_odds >= params_.keep_log_odds &&
        kept.size() < static_cast<std::size_t>(params_.count)) {
      kept.push_back(one);
    }
  }
  all_ = std::move(kept);
}

double Challengers::probability(double log_odds, double tracked_log_odds) const {
  double most = std::max({0.0, log_odds, tracked_log_odds});
  for (const Challenger& one : all_) {
    most = std::max(most, one.belief.log_odds);
  }
  double sum = std::exp(-most) + std::exp(tracked_log_odds - most);
  for (const Challenger& one : all_) {
    sum += std::exp(one.belief.log_odds - most);
  }
  return std::exp(log_odds - most) / sum;
}

bool Challengers::first_takes_over(double tracked_log_odds) const {
  if (all_.empty()) {
    return false;
  }
  const double first = all_.front().belief.log_odds;
  return first >= tracked_log_odds + params_.take_over_log_odds &&
         probability(first, tracked_log_odds) >= params_.take_over_probability;
}

bool Challengers::are_one(const Sim2& first, const Sim2& second) const {
  const double bound_px = params_.apart_m * std::sqrt(first.scale() * second.scale());
  return std::hypot(first.x() - second.x(), first.y() - second.y()) < bound_px &&
         std::abs(wrap_rad(first.yaw_rad() - second.yaw_rad())) < params_.apart_rad;
}

}  // namespace sketchloc
