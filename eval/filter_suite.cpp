#include "eval/filter_suite.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "eval/simulated_drive.hpp"
#include "motion/random.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

constexpr std::uint64_t kSuite = 0xF117E2;
constexpr std::uint64_t kDropoutStream = 0xD209;
constexpr double kDropoutShare = 1.0 / 3.0;

using Spoil = std::function<void(Run&, Rng&)>;

FilterTask task_of(const std::string& kind, const DriveName& name, const DataSetParams& params,
                   std::uint64_t seed, const Spoil& spoil = {}) {
  const std::string set = kind + " plan " + std::to_string(name.plan + 1) + " drawing " +
                          std::to_string(name.drawing + 1);
  return {.set = set, .kind = kind, .make = [=] {
            DataSet made = simulated_drive(name, params, seed);
            if (spoil) {
              Rng rng = make_rng(seed, kDropoutStream, static_cast<std::uint64_t>(name.plan));
              spoil(made.run, rng);
            }
            return FilterData{.sketch = std::move(made.drawing.sketch),
                              .run = std::move(made.run),
                              .reference = std::move(made.reference)};
          }};
}

void add_drives(std::vector<FilterTask>& tasks, const std::string& kind,
                const FilterSuiteParams& suite, const DataSetParams& params, std::uint64_t seed,
                const Spoil& spoil = {}) {
  for (int plan = 0; plan < suite.plans; ++plan) {
    for (int drawing = 0; drawing < suite.drawings; ++drawing) {
      tasks.push_back(
          task_of(kind, {.suite = kSuite, .plan = plan, .drawing = drawing}, params, seed, spoil));
    }
  }
}

DataSetParams drive_of(const FilterSuiteParams& suite, const PersonParams& person) {
  return {.person = person, .drive = {.length_m = suite.drive_m}};
}

OdometryNoise noise_of(double share) {
  return {.slip_m_per_m = share,
          .slip_m_per_rad = 0.01,
          .turn_rad_per_m = 0.25 * share,
          .turn_rad_per_rad = share};
}

void drop_scans(Run& run, Rng& rng) {
  for (RunStep& step : run.steps) {
    if (uniform(rng) < kDropoutShare) {
      std::ranges::fill(step.scan.ranges_m, std::numeric_limits<float>::quiet_NaN());
    }
  }
}

}  // namespace

void validate(const FilterSuiteParams& params) {
  require_at_least("plans", params.plans, 0.0);
  require_at_least("drawings", params.drawings, 1.0);
  require_above("drive_m", params.drive_m, 0.0);
}

std::vector<FilterTask> simulated_drives(const FilterSuiteParams& params, std::uint64_t seed) {
  validate(params);
  std::vector<FilterTask> tasks;
  add_drives(tasks, "tps", params, drive_of(params, tps_person()), seed);
  add_drives(tasks, "human", params, drive_of(params, human_person()), seed);
  return tasks;
}

std::vector<FilterTask> robust_drives(const FilterSuiteParams& params, std::uint64_t seed) {
  validate(params);
  std::vector<FilterTask> tasks;
  const DataSetParams plain = drive_of(params, human_person());
  add_drives(tasks, "plain", params, plain, seed);
  for (const auto& [kind, share] :
       {std::pair("odometry 20 %", 0.2), std::pair("odometry 40 %", 0.4)}) {
    DataSetParams noisy = plain;
    noisy.odometry.noise = noise_of(share);
    add_drives(tasks, kind, params, noisy, seed);
  }
  DataSetParams sparse = plain;
  sparse.person->pen.left_out_share = 0.2;
  add_drives(tasks, "walls missing", params, sparse, seed);
  add_drives(tasks, "dropouts", params, plain, seed, drop_scans);
  return tasks;
}

}  // namespace sketchloc
