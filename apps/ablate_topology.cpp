#include <spdlog/spdlog.h>

#include <iostream>
#include <optional>
#include <stdexcept>

#include "apps/ablate_suites.hpp"
#include "apps/labelled_run.hpp"
#include "apps/output_folder.hpp"
#include "apps/parallel.hpp"
#include "apps/progress.hpp"
#include "apps/ranks.hpp"
#include "datasets/io/atomic_file.hpp"
#include "eval/topology_suite.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

/// A trajectory with its labels, or a log with its true labels.
LabelledRunFiles files_of(const std::vector<std::string>& parts) {
  LabelledRunFiles files{.reference = parts[2]};
  if (fs::path(parts[0]).extension() == ".tum") {
    files.trajectory = parts[0];
    files.labels = parts[1];
  } else {
    files.log = parts[0];
    files.reference_labels = parts[1];
  }
  return files;
}

TopologySet topology_set(const std::string& text) {
  const std::vector<std::string> parts = split_text(text, ',');
  if (parts.size() < 3 || parts.size() > 4) {
    throw std::invalid_argument(
        "--set " + text +
        ": give TRAJECTORY.tum,LABELS.csv,REFERENCE.tum[,NAME], or a log instead "
        "of the trajectory");
  }
  const LabelledRunFiles files = files_of(parts);
  LabelledRun run = read_labelled_run(files);
  const std::string name =
      parts.size() > 3 ? parts[3] : fs::path(parts[0]).parent_path().filename().string();
  TopologySet set{.name = name.empty() ? fs::path(parts[0]).stem().string() : name,
                  .odometry = std::move(run.odometry),
                  .labels = std::move(run.labels),
                  .reference = std::move(run.reference).value()};
  if (!files.log.empty()) {
    set.log = TopologySet::Log{.scans = std::move(run.scans),
                               .told = std::move(set.labels),
                               .raw = std::move(run.raw_odom_from_robot)};
    set.labels = std::move(run.reference_labels).value();
  }
  return set;
}

std::vector<TopologySet> topology_sets(const AblateOptions& options) {
  if (options.sets.empty()) {
    throw std::invalid_argument(
        "--suite topology needs recorded runs: --set TRAJECTORY.tum,LABELS.csv,REFERENCE.tum");
  }
  if (!options.methods.empty() || !options.networks.empty()) {
    throw std::invalid_argument("--suite topology knows no --methods and no --network");
  }
  std::vector<TopologySet> sets;
  std::vector<std::string> names;
  for (const std::string& text : options.sets) {
    sets.push_back(topology_set(text));
    if (!sets.back().log) {  // logs of one name share a row
      names.push_back(sets.back().name);
    }
  }
  check_set_names(names);
  return sets;
}

}  // namespace

void run_topology_suite(const AblateOptions& options) {
  if (processes_started() > 1) {
    throw std::invalid_argument("--suite topology runs in one process; leave out mpirun");
  }
  const AblateParams params = suite_parameters(options.parameters);
  OutputFolder out(options.out, options.force);
  const std::vector<TopologySet> sets = topology_sets(options);
  const std::vector<TopologyTask> tasks =
      topology_tasks(sets, params.topology_suite, options.seeds);
  std::vector<std::optional<TopologyTrial>> done(tasks.size());
  Progress progress("ablate", tasks.size());
  work_in_parallel(
      tasks.size(), options.jobs,
      [&](std::size_t i) { done[i] = run_task(tasks[i], sets, params.topology, options.seed); },
      [&](std::size_t count) { progress.update(count); });
  std::vector<TopologyTrial> trials;
  for (std::optional<TopologyTrial>& trial : done) {
    trials.push_back(*std::move(trial));
  }
  write_atomically(out / "report.html", topology_suite_html(trials));
  write_atomically(out / "metrics.json", topology_suite_json(trials));
  write_atomically(out / "trials.csv", topology_trials_csv(trials));
  write_atomically(out / "run.yaml", run_file_text(description_of(options, suite_config(params))));
  out.commit();
  std::cout << topology_suite_markdown(trials)
            << "report: " << (out.target() / "report.html").string() << "\n";
}

}  // namespace sketchloc
