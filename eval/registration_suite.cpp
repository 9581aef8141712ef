#include "eval/registration_suite.hpp"

#include <algorithm>
#include <iterator>

#include "eval/detail/text.hpp"
#include "eval/simulated_drive.hpp"
#include "motion/angles.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

constexpr std::uint64_t kSuite = 0x7AB1E1;
constexpr double kSweepTurn_deg = 10.0;  ///< beside a swept shift
constexpr double kSweepShift_m = 0.5;    ///< beside a swept turn

const std::string kShiftPrefix = "shift ";
const std::string kTurnPrefix = "turn ";
const std::string kBendPrefix = "tps x ";

RegistrationTask task_of(const std::string& kind, int plan, int warp, const PersonParams& person,
                         const RegistrationSuiteParams& params, std::uint64_t seed) {
  const std::string name =
      kind + " plan " + std::to_string(plan + 1) + " drawing " + std::to_string(warp + 1);
  return {
      .set = name,
      .make =
          [=] {
            return make_registration_set(
                name, kind,
                simulated_drive({.suite = kSuite, .plan = plan, .drawing = warp},
                                {.person = person, .drive = {.length_m = params.drive_m}}, seed),
                params.set);
          },
      .around_truth = {main_protocol(params)},
      .seed = make_rng(seed, static_cast<std::uint64_t>(plan), static_cast<std::uint64_t>(warp))()};
}

std::vector<PriorProtocol> swept_priors() {
  std::vector<PriorProtocol> protocols;
  const auto add = [&](const std::string& name, double shift_m, double turn_deg) {
    protocols.push_back({.name = name,
                         .spread = {.shift_m = shift_m,
                                    .turn_rad = rad_from_deg(turn_deg),
                                    .log_scale_sigma = 0.1,
                                    .exact = true}});
  };
  for (const double shift_m : kSweptShifts_m) {
    add(shift_protocol(shift_m), shift_m, kSweepTurn_deg);
  }
  for (const double turn_deg : kSweptTurns_deg) {
    add(turn_protocol(turn_deg), kSweepShift_m, turn_deg);
  }
  return protocols;
}

std::uint64_t prior_seed(const RegistrationTask& task, std::size_t protocol) {
  return make_rng(task.seed, protocol)();
}

}  // namespace

void validate(const RegistrationSuiteParams& params) {
  require_at_least("plans", params.plans, 0.0);
  require_at_least("warps", params.warps, 1.0);
  require_above("drive_m", params.drive_m, 0.0);
  require_at_least("prior_shift_m", params.prior_shift_m, 0.0);
  require_in_range("prior_turn_deg", params.prior_turn_deg, 0.0, 180.0);
  validate_part("set", params.set);
}

std::string shift_protocol(double shift_m) {
  return kShiftPrefix + detail::short_number(shift_m) + " m";
}
std::string turn_protocol(double turn_deg) {
  return kTurnPrefix + detail::short_number(turn_deg) + " deg";
}
std::string bend_kind(double strength) { return kBendPrefix + detail::short_number(strength); }

bool is_swept(const std::string& kind, const std::string& protocol) {
  return protocol.starts_with(kShiftPrefix) || protocol.starts_with(kTurnPrefix) ||
         kind.starts_with(kBendPrefix);
}

PriorProtocol main_protocol(const RegistrationSuiteParams& params) {
  return {.name = "within " + detail::short_number(params.prior_shift_m) + " m " +
                  detail::short_number(params.prior_turn_deg) + " deg",
          .spread = {.shift_m = params.prior_shift_m,
                     .turn_rad = rad_from_deg(params.prior_turn_deg),
                     .log_scale_sigma = 0.1}};
}

std::vector<RegistrationTask> simulated_tasks(const RegistrationSuiteParams& params,
                                              std::uint64_t seed) {
  validate(params);
  std::vector<RegistrationTask> tasks;
  const auto add = [&](const std::string& kind, const PersonParams& person, int warps,
                       bool sweeps_priors) {
    for (int plan = 0; plan < params.plans; ++plan) {
      for (int warp = 0; warp < warps; ++warp) {
        RegistrationTask task = task_of(kind, plan, warp, person, params, seed);
        if (sweeps_priors && warp == 0) {
          std::ranges::move(swept_priors(), std::back_inserter(task.around_truth));
        }
        tasks.push_back(std::move(task));
      }
    }
  };
  add("tps", tps_person(), params.warps, params.sweeps);
  add("human", human_person(), params.warps, params.sweeps);
  for (const double strength : kSweptBends) {
    if (params.sweeps) {
      PersonParams person = tps_person();
      person.distortion.bend_share *= strength;
      add(bend_kind(strength), person, 1, false);
    }
  }
  return tasks;
}

Sim2 first_prior_of(const RegistrationTask& task, const RegistrationSet& set, std::size_t index) {
  Rng rng = make_rng(prior_seed(task, 0), index);
  return prior_around(set.steps.at(index).sketch_from_robot, task.around_truth.at(0).spread, rng);
}

std::vector<RegistrationTrial> run_task(const RegistrationTask& task, const RegistrationSet& set,
                                        const RegistrationMethodUse& method) {
  std::vector<RegistrationTrial> trials;
  if (task.chained) {
    trials = run_chained(set, method);
  }
  for (std::size_t i = 0; i < task.around_truth.size(); ++i) {
    const PriorProtocol& protocol = task.around_truth[i];
    std::ranges::move(
        run_around_truth(set, method, protocol.name, protocol.spread, prior_seed(task, i)),
        std::back_inserter(trials));
  }
  return trials;
}

}  // namespace sketchloc
