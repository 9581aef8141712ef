#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "filter/localized_belief.hpp"
#include "filter/particle_set.hpp"
#include "motion/random.hpp"
#include "motion/se2.hpp"
#include "motion/sim2.hpp"
#include "registration/warp_predictor.hpp"

namespace sketchloc {

/// Other places where the robot may be, found and followed by registrations: how a lost robot is
/// found, and how it starts anywhere.
struct ChallengerParams {
  int count = 8;                      ///< followed at a time; 0: none, in [0, 64]
  double way_m = 0.5;                 ///< between registrations of one, > 0
  double independent_way_m = 2.0;     ///< after which a registration knows nothing of the last, > 0
  double lost_priors_per_m = 16;      ///< registrations for a metre of way while lost, >= 0
  double calm_priors_per_m = 1;       ///< the same while localized, >= 0
  int max_priors = 8;                 ///< in one step, >= 1
  double keep_log_odds = -4.2;        ///< a challenger that is less likely is given up
  double established_log_odds = 3.0;  ///< at which the tracked pose has proved itself
  double lost_log_odds = -5.0;        ///< at which one that had may lose its place all the same
  double take_over_log_odds = 3.0;    ///< more than the tracked pose's, to take its place, >= 0
  double take_over_probability = 0.6;  ///< of a challenger that does so, in [0, 1]
  double apart_m = 2.0;                ///< nearer to each other they are one, > 0
  double apart_rad = 0.6;              ///< and headed this alike, > 0
};

template <typename Visitor>
void visit_fields(ChallengerParams& params, Visitor&& visit) {
  visit("count", params.count);
  visit("way_m", params.way_m);
  visit("independent_way_m", params.independent_way_m);
  visit("lost_priors_per_m", params.lost_priors_per_m);
  visit("calm_priors_per_m", params.calm_priors_per_m);
  visit("max_priors", params.max_priors);
  visit("keep_log_odds", params.keep_log_odds);
  visit("established_log_odds", params.established_log_odds);
  visit("lost_log_odds", params.lost_log_odds);
  visit("take_over_log_odds", params.take_over_log_odds);
  visit("take_over_probability", params.take_over_probability);
  visit("apart_m", params.apart_m);
  visit("apart_rad", params.apart_rad);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const ChallengerParams& params);

/// One of them. Plain data.
struct Challenger {
  Sim2 sketch_from_robot;
  LocalizedBelief belief;
  double way_since_look_m = 0.0;
};

/// The bank of challengers, most likely first.
class Challengers {
 public:
  explicit Challengers(const ChallengerParams& params) : params_((validate(params), params)) {}

  void forget();

  void save(StateWriter& state) const;
  void load(StateReader& state);

  /// The robot has moved; `calm`: probability that the tracked pose is right.
  void move(const Se2& robot_from_next, double calm);

  /// Takes out those that are to be registered now, the one that waited longest first; spends the
  /// budget.
  std::vector<Challenger> take_due();

  /// How many newcomers the budget allows to register; spends it.
  std::size_t take_newcomers();

  /// Poses for newcomers, drawn by weight, apart from each other, from the challengers and from
  /// the tracked pose.
  std::vector<Sim2> pick(const ParticleSet& candidates, std::size_t count,
                         const Sim2& tracked_sketch_from_robot, Rng& rng) const;

  /// How much of what a challenger sees is new since its last look.
  double new_share(const Challenger& challenger) const;

  void add(const Challenger& challenger) { all_.push_back(challenger); }
  std::vector<Challenger>& all() { return all_; }
  std::span<const Challenger> all() const { return all_; }

  /// Sorts, and gives up the unlikely ones, those that are one with a likelier one or with the
  /// tracked pose, and those that are too many.
  void tidy(const Sim2& tracked_sketch_from_robot);

  /// The probability of a hypothesis, the tracked pose or a challenger, among all of them; they
  /// exclude each other, and their odds are against all that nobody thought of.
  double probability(double log_odds, double tracked_log_odds) const;

  /// Whether the first one is to take the tracked pose's place.
  bool first_takes_over(double tracked_log_odds) const;

  /// Whether two poses are one hypothesis.
  bool are_one(const Sim2& first, const Sim2& second) const;

 private:
  ChallengerParams params_;
  std::vector<Challenger> all_;
  double budget_ = 0.0;  ///< registrations
};

}  // namespace sketchloc
