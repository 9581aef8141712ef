#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "datasets/sim/person.hpp"
#include "eval/registration_set.hpp"
#include "eval/registration_trials.hpp"

namespace sketchloc {

/// What the registration suite asks. [Chen20, Table I]
struct RegistrationSuiteParams {
  int plans = 10;                ///< buildings that no network has seen, >= 0
  int warps = 5;                 ///< drawings of each, one drive in each, >= 1
  double drive_m = 20.0;         ///< way of a drive, > 0
  bool sweeps = true;            ///< ask also by prior error and by strength of the deformation
  double prior_shift_m = 2.0;    ///< of the priors around the truth, >= 0
  double prior_turn_deg = 20.0;  ///< in [0, 180]
  RegistrationSetParams set;
};

template <typename Visitor>
void visit_fields(RegistrationSuiteParams& params, Visitor&& visit) {
  visit("plans", params.plans);
  visit("warps", params.warps);
  visit("drive_m", params.drive_m);
  visit("sweeps", params.sweeps);
  visit("prior_shift_m", params.prior_shift_m);
  visit("prior_turn_deg", params.prior_turn_deg);
  visit("set", params.set);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const RegistrationSuiteParams& params);

/// Priors of one kind, with the name that tables have for it.
struct PriorProtocol {
  std::string name;
  PriorSpread spread;
};

/// A drive in a drawing and what to ask there; made when it is needed.
struct RegistrationTask {
  std::string set;
  std::function<RegistrationSet()> make;
  bool chained = true;
  std::vector<PriorProtocol> around_truth;
  std::uint64_t seed = 0;  ///< of the priors
};

/// Names of the protocols that sweep the error of the priors.
std::string shift_protocol(double shift_m);
std::string turn_protocol(double turn_deg);
inline constexpr double kSweptShifts_m[] = {0.0, 0.5, 1.0, 1.5, 2.0, 3.0};
inline constexpr double kSweptTurns_deg[] = {0.0, 10.0, 20.0, 30.0, 45.0};
inline constexpr double kSweptBends[] = {0.0, 0.5, 1.0, 1.5, 2.0};  ///< times that of tps_person()
std::string bend_kind(double strength);

/// Whether a row is a point of a sweep rather than a result of its own.
bool is_swept(const std::string& kind, const std::string& protocol);

/// The protocol of params.prior_*.
PriorProtocol main_protocol(const RegistrationSuiteParams& params);

/// All simulated drives: kinds "tps" and "human", with the sweeps "tps x 0.5" ... as well.
std::vector<RegistrationTask> simulated_tasks(const RegistrationSuiteParams& params,
                                              std::uint64_t seed);

/// The prior that the first of task.around_truth has at a step.
Sim2 first_prior_of(const RegistrationTask& task, const RegistrationSet& set, std::size_t index);

/// All answers of one method to one task.
std::vector<RegistrationTrial> run_task(const RegistrationTask& task, const RegistrationSet& set,
                                        const RegistrationMethodUse& method);

}  // namespace sketchloc
