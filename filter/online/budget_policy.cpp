#include "filter/online/budget_policy.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/validate.hpp"

namespace sketchloc {

void validate(const BudgetParams& params) {
  require_in_range("planned_share", params.planned_share, 0.01, 1.0);
  require_at_least("min_particles", static_cast<double>(params.min_particles), 1.0);
  require_in_range("memory", params.memory, 1, 1000);
  require_in_range("registrations_memory", params.registrations_memory, 1, 1000);
  require_in_range("rarest", params.rarest, 1, 100000);
}

BudgetPolicy::BudgetPolicy(const BudgetParams& params, std::optional<double> deadline_s)
    : params_((validate(params), params)),
      deadline_s_(deadline_s),
      before_(params.memory),
      per_particle_(params.memory),
      registration_(params.registrations_memory) {
  if (deadline_s_) {
    require_above("deadline_s", *deadline_s_, 0.0);
  }
}

void BudgetPolicy::Recent::add(double seconds) {
  seconds_.push_back(seconds);
  if (seconds_.size() > memory_) {
    seconds_.pop_front();
  }
}

double BudgetPolicy::Recent::usual() const {
  if (seconds_.empty()) {
    return 0.0;
  }
  std::vector<double> sorted(seconds_.begin(), seconds_.end());
  std::ranges::sort(sorted);
  // A machine that was busy elsewhere for a moment must not count for many steps.
  return sorted[(3 * (sorted.size() - 1)) / 4];
}

double BudgetPolicy::cheapest_s() const {
  return before_.usual() + static_cast<double>(params_.min_particles) * per_particle_.usual();
}

StepPlan BudgetPolicy::plan(double age_s) {
  StepPlan plan;
  ++since_registration_;
  if (!deadline_s_) {
    return plan;
  }
  const double left_s = params_.planned_share * *deadline_s_ - age_s;
  const double spare_s = left_s - cheapest_s();  // beside the fewest particles
  const bool fits = registration_.usual() <= spare_s;
  if (!fits) {
    // Spread over so many scans it fits again, as far as anything does.
    const double scans = spare_s > 0.0 ? std::ceil(registration_.usual() / spare_s)
                                       : static_cast<double>(params_.rarest);
    plan.register_every = static_cast<int>(std::clamp(scans, 2.0, double(params_.rarest)));
    plan.budget.may_register = since_registration_ >= plan.register_every;
  }
  if (per_particle_.usual() > 0.0) {
    const double reserved_s = plan.budget.may_register ? registration_.usual() : 0.0;
    const double affordable = std::max(spare_s - reserved_s, 0.0) / per_particle_.usual();
    plan.budget.max_particles =
        params_.min_particles + static_cast<std::size_t>(std::min(affordable, 1e9));
  }
  return plan;
}

void BudgetPolicy::learn(const StepCost& cost) {
  before_.add(cost.before_s);
  if (cost.looked) {
    since_registration_ = 0;
    const double others_s = static_cast<double>(cost.particles) * per_particle_.usual();
    registration_.add(std::max(cost.localizer_s - others_s, 0.0));
  } else if (cost.updated && cost.particles > 0) {
    per_particle_.add(cost.localizer_s / static_cast<double>(cost.particles));
  }
}

}  // namespace sketchloc
