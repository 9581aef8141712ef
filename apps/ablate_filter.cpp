#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <memory>
#include <mutex>
#include <set>
#include <stdexcept>

#include "apps/ablate_suites.hpp"
#include "apps/given_network.hpp"
#include "apps/output_folder.hpp"
#include "apps/parallel.hpp"
#include "apps/progress.hpp"
#include "apps/unfinished_work.hpp"
#include "datasets/io/atomic_file.hpp"
#include "eval/filter_summary.hpp"
#include "eval/lost_drives.hpp"
#include "eval/lost_summary.hpp"
#include "registration/network_predictor.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

/// What --network calls the method's registration.
std::string network_name(const FilterMethod& method) {
  for (const auto& [name, registration] : names_of(RegistrationMethod{})) {
    if (registration == method.registration) {
      return std::string(name);
    }
  }
  return {};
}

std::vector<FilterMethod> methods_of(const AblateOptions& options) {
  const std::vector<FilterMethod> all = filter_methods();
  std::vector<std::string> wanted = options.methods;
  if (wanted.empty()) {
    std::ranges::transform(all, std::back_inserter(wanted), &FilterMethod::name);
  }
  std::vector<FilterMethod> methods;
  for (const std::string& name : wanted) {
    const auto found = std::ranges::find(all, name, &FilterMethod::name);
    if (found == all.end()) {
      std::string names;
      for (const FilterMethod& method : all) {
        names += (names.empty() ? "" : ", ") + method.name;
      }
      throw std::invalid_argument("--methods: there is no " + name + "; there are " + names);
    }
    if (!found->registration ||
        can_run(*found->registration, name, network_given(options, network_name(*found)))) {
      methods.push_back(*found);
    }
  }
  return methods;
}

std::vector<FilterTask> tasks_of(const AblateOptions& options, const FilterSuiteParams& params) {
  std::vector<FilterTask> tasks;
  if (options.suite == "filter") {
    tasks = simulated_drives(params, options.seed);
  } else if (options.suite == "robust") {
    tasks = robust_drives(params, options.seed);
    for (FilterTask& task : lost_drives(params, options.seed)) {
      tasks.push_back(std::move(task));
    }
  }
  for (const RecordedSet& recorded : recorded_sets(options)) {
    tasks.push_back({.set = recorded.name, .kind = recorded.kind, .make = [recorded] {
                       return recorded.read();
                     }});
  }
  return tasks;
}

/// What the work depends on beside its options: program, networks, recorded runs.
std::string stamps_of(const AblateOptions& options) {
  std::error_code error;
  std::string stamps = stamp_of(fs::read_symlink("/proc/self/exe", error));
  for (const char* method : {"ours", "chen20", "affine"}) {
    const fs::path network = network_given(options, method);
    stamps += network.empty() ? "" : stamp_of(network);
  }
  for (const RecordedSet& recorded : recorded_sets(options)) {
    for (const fs::path& file :
         {recorded.drawing, recorded.log, recorded.reference, recorded.alternative}) {
      stamps += file.empty() ? "" : stamp_of(file);
    }
  }
  return stamps;
}

/// Throws std::invalid_argument where two have one name.
void check_names(const std::vector<FilterTask>& tasks, const std::vector<FilterMethod>& methods) {
  std::vector<std::string> sets;
  std::ranges::transform(tasks, std::back_inserter(sets), &FilterTask::set);
  check_set_names(sets);
  std::set<std::string> names;
  for (const FilterMethod& method : methods) {
    if (!names.insert(method.name).second) {
      throw std::invalid_argument("--methods: " + method.name + " is there twice");
    }
  }
}

/// Runs every method on every set with every seed; what is done is kept for the next time.
class FilterAblation {
 public:
  explicit FilterAblation(const AblateOptions& options)
      : options_(options),
        params_(parameters_from<AblateParams>(options.parameters)),
        methods_(methods_of(options)),
        tasks_(tasks_of(options, params_.drives)) {
    validate(params_.filter);
    if (tasks_.empty() || methods_.empty()) {
      throw std::invalid_argument(
          "there is nothing to run: give a --set" +
          std::string(options.suite == "real" ? "" : ", or --drives.plans above 0, and a method"));
    }
    check_names(tasks_, methods_);
    for (const RecordedSet& recorded : recorded_sets(options)) {
      check_start(recorded.name, recorded.read());  // complains now, not after the first drives
    }
    params_.filter.localizer.jobs = 1;  // sets run side by side
    for (const FilterMethod& method : methods_) {
      predictor_of(method);  // the same
    }
  }

  std::vector<FilterTrial> run(UnfinishedWork& work) {
    std::vector<std::vector<FilterTrial>> of_task(tasks_.size());
    Progress progress("ablate", tasks_.size());
    work_in_parallel(
        tasks_.size(), options_.jobs, [&](std::size_t i) { of_task[i] = run_one(tasks_[i], work); },
        [&](std::size_t done) { progress.update(done); });
    std::vector<FilterTrial> trials;
    for (std::vector<FilterTrial>& some : of_task) {
      std::ranges::move(some, std::back_inserter(trials));
    }
    return trials;
  }

  ConfigNode parameters() const { return to_config(params_); }
  const std::vector<FilterMethod>& methods() const { return methods_; }
  std::size_t tasks() const { return tasks_.size(); }

 private:
  std::unique_ptr<WarpPredictor> predictor_of(const FilterMethod& method) const {
    return method.registration
               ? predictor_from(*method.registration, network_given(options_, network_name(method)),
                                params_.filter.predictor)
               : nullptr;
  }

  /// One thread's part: all methods and seeds on one set.
  std::vector<FilterTrial> run_one(const FilterTask& task, UnfinishedWork& work) const {
    std::optional<FilterData> data;
    std::vector<FilterTrial> trials;
    for (const FilterMethod& method : methods_) {
      const int seeds =
          method.method == Method::Mcl ? options_.seeds : 1;  // the others draw nothing
      for (int i = 0; i < seeds; ++i) {
        const std::uint64_t seed = options_.seed + static_cast<std::uint64_t>(i);
        const std::string name = task.set + ", " + method.name + ", " + std::to_string(seed);
        if (const std::optional<std::string> done = work.find(name)) {
          trials.push_back(trial_from_json(*done));
          const FilterTrial& trial = trials.back();
          if (trial.set != task.set || trial.method != method.name || trial.seed != seed) {
            throw std::runtime_error("the unfinished piece " + name + " is of another run");
          }
          continue;
        }
        if (!data) {
          data = task.make();
        }
        const auto alone = method.registration == RegistrationMethod::Icp
                               ? std::unique_lock(icp_)  // Open3D has global state
                               : std::unique_lock<std::mutex>();
        trials.push_back(run_filter_trial(task, *data, method, params_.filter, seed,
                                          predictor_of(method).get()));
        work.keep(name, trial_json(trials.back()));
      }
    }
    return trials;
  }

  const AblateOptions& options_;
  AblateParams params_;
  std::vector<FilterMethod> methods_;
  std::vector<FilterTask> tasks_;
  mutable std::mutex icp_;
};

}  // namespace

void run_filter_suite(const AblateOptions& options) {
  run_networks_on_one_thread();
  OutputFolder out(options.out, options.force);
  FilterAblation ablation(options);
  const std::string run_file = run_file_text(description_of(options, ablation.parameters()));
  UnfinishedWork work(options.out, run_file + stamps_of(options));
  const std::vector<FilterTrial> trials = ablation.run(work);
  const std::vector<FilterRow> rows = summarize_filter(trials, options.seed);
  const std::vector<FilterDifference> differences =
      compare_filter(trials, ablation.methods().back().name, options.seed);
  const std::string caption =
      std::to_string(ablation.tasks()) + " runs, " + std::to_string(options.seeds) +
      " seeds of the filter on each, seed " + std::to_string(options.seed) +
      "; with matched odometry, from the reference's first pose unless the kind says otherwise.";
  std::string lines;
  for (const FilterTrial& trial : trials) {
    lines += trial_json(trial);
  }
  write_atomically(out / "report.html",
                   filter_page_html("Ablation: " + options.suite, caption, rows, differences));
  write_atomically(out / "metrics.json", filter_json(rows, differences));
  const std::vector<LostRow> lost = summarize_lost(trials);
  write_atomically(out / "lost.json", lost_json(lost));
  write_atomically(out / "trials.jsonl", lines);
  write_atomically(out / "run.yaml", run_file);
  out.commit();
  work.finish();
  std::cout << filter_markdown(rows) << "\n"
            << lost_markdown(lost) << "report: " << (out.target() / "report.html").string() << "\n";
}

}  // namespace sketchloc
