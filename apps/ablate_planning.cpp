#include <chrono>
#include <iostream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "apps/ablate_suites.hpp"
#include "apps/output_folder.hpp"
#include "apps/parallel.hpp"
#include "apps/progress.hpp"
#include "apps/ranks.hpp"
#include "datasets/io/atomic_file.hpp"

namespace sketchloc {
namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void refuse_what_is_not_known(const AblateOptions& options) {
  if (!options.methods.empty() || !options.networks.empty() || !options.sets.empty()) {
    throw std::invalid_argument("--suite planning knows no --methods, --network and --set");
  }
  if (processes_started() > 1) {
    throw std::invalid_argument("--suite planning runs in one process; leave out mpirun");
  }
}

}  // namespace

void run_planning_suite(const AblateOptions& options) {
  refuse_what_is_not_known(options);
  const AblateParams params = suite_parameters(options.parameters);
  OutputFolder out(options.out, options.force);
  std::vector<std::vector<PlanningTrial>> by_drawing(
      static_cast<std::size_t>(params.planning_suite.drawings));
  Progress progress("ablate", by_drawing.size());
  work_in_parallel(
      by_drawing.size(), options.jobs,
      [&](std::size_t i) {
        by_drawing[i] = ask_about_drawing(static_cast<int>(i), params.planning_suite,
                                          params.planning, options.seed, now_s);
      },
      [&](std::size_t count) { progress.update(count); });
  std::vector<PlanningTrial> trials;
  for (const std::vector<PlanningTrial>& some : by_drawing) {
    trials.insert(trials.end(), some.begin(), some.end());
  }
  write_atomically(out / "report.html", planning_suite_html(trials, options.seed));
  write_atomically(out / "metrics.json", planning_suite_json(trials, options.seed));
  write_atomically(out / "trials.csv", planning_trials_csv(trials));
  write_atomically(out / "run.yaml", run_file_text(description_of(options, suite_config(params))));
  out.commit();
  std::cout << planning_suite_markdown(trials, options.seed)
            << "report: " << (out.target() / "report.html").string() << "\n";
}

}  // namespace sketchloc
