#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "filter/localizer.hpp"

namespace sketchloc {

/// How steps keep a deadline.
struct BudgetParams {
  double planned_share = 0.7;  ///< of the deadline; the rest is for what nobody foresees, in (0, 1]
  std::size_t min_particles = 1000;  ///< never fewer to save time, >= 1
  int memory = 10;                   ///< steps looked back at to know what steps cost, >= 1
  int registrations_memory = 3;      ///< the same for registrations, >= 1
  int rarest = 50;  ///< a registration is tried every so many scans, even if there is no time, >= 1
};

template <typename Visitor>
void visit_fields(BudgetParams& params, Visitor&& visit) {
  visit("planned_share", params.planned_share);
  visit("min_particles", params.min_particles);
  visit("memory", params.memory);
  visit("registrations_memory", params.registrations_memory);
  visit("rarest", params.rarest);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const BudgetParams& params);

/// What one step took.
struct StepCost {
  double before_s = 0.0;  ///< all but the localizer: the odometry's refinement
  double localizer_s = 0.0;
  std::size_t particles = 0;
  bool updated = false;
  bool looked = false;  ///< a registration was tried
};

/// What the next step may do.
struct StepPlan {
  StepBudget budget;
  int register_every = 1;  ///< scans; 1: whenever it is due

  friend bool operator==(const StepPlan& a, const StepPlan& b) {
    return a.budget.max_particles == b.budget.max_particles &&
           a.budget.may_register == b.budget.may_register && a.register_every == b.register_every;
  }
};

/// Plans steps so that they keep a deadline, from what the last ones took: first fewer particles,
/// then registrations at every n-th scan only. Everything comes back when it fits again. A pure
/// function of what it is told; reads no clock.
class BudgetPolicy {
 public:
  /// Without a deadline everything is always allowed. Throws std::invalid_argument if a parameter
  /// is out of range or the deadline is not above 0.
  BudgetPolicy(const BudgetParams& params, std::optional<double> deadline_s);

  /// For a scan that has waited so long already.
  StepPlan plan(double age_s);

  void learn(const StepCost& cost);

  /// What a step with the fewest particles and no registration takes; 0 as long as nobody knows.
  double cheapest_s() const;

  std::optional<double> deadline_s() const { return deadline_s_; }

 private:
  /// The last few costs of one kind.
  class Recent {
   public:
    explicit Recent(int memory) : memory_(static_cast<std::size_t>(memory)) {}
    void add(double seconds);
    /// Most of them, but not a single bad one; 0 where nothing is known.
    double usual() const;

   private:
    std::size_t memory_;
    std::deque<double> seconds_;
  };

  BudgetParams params_;
  std::optional<double> deadline_s_;
  Recent before_;
  Recent per_particle_;
  Recent registration_;
  int since_registration_ = 0;  ///< scans
};

}  // namespace sketchloc
