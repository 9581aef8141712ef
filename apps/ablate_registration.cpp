#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <stdexcept>

#include "apps/ablate_suites.hpp"
#include "apps/given_network.hpp"
#include "apps/output_folder.hpp"
#include "apps/parallel.hpp"
#include "apps/progress.hpp"
#include "apps/ranks.hpp"
#include "datasets/io/atomic_file.hpp"
#include "eval/registration_page.hpp"
#include "eval/registration_picture.hpp"
#include "motion/angles.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kTypicalShown = 6;
constexpr std::size_t kWorstShown = 9;

/// A method with its network, ready to make predictors of; `none` keeps the prior.
struct NamedMethod {
  std::string name;
  std::optional<RegistrationMethod> method;
  fs::path network;  ///< given instead of the shipped one; empty: none
};

NamedMethod method_of(const std::string& name, const AblateOptions& options) {
  if (name == "none") {
    return {.name = name, .method = {}, .network = {}};
  }
  const auto found = registration_methods().find(name);
  if (found == registration_methods().end()) {
    throw std::invalid_argument("--methods: there is no " + name +
                                "; there are ours, chen20, affine, icp and none");
  }
  return {.name = name, .method = found->second, .network = network_given(options, name)};
}

/// The methods that can run here; the others are left out with a message.
std::vector<NamedMethod> methods_of(const AblateOptions& options) {
  const std::vector<std::string> all = {"ours", "chen20", "affine", "icp", "none"};
  std::vector<NamedMethod> methods;
  for (const std::string& name : options.methods.empty() ? all : options.methods) {
    NamedMethod method = method_of(name, options);
    if (!method.method || can_run(*method.method, name, method.network)) {
      methods.push_back(std::move(method));
    }
  }
  return methods;
}

/// Predictors are not to be shared between threads, so every task makes its own.
class Predictors {
 public:
  Predictors(const std::vector<NamedMethod>& methods, const NetworkPredictorParams& params) {
    for (const NamedMethod& named : methods) {
      if (named.method) {
        predictors_.push_back(predictor_from(*named.method, named.network, params));
      }
      uses_.push_back({.name = named.name,
                       .predictor = named.method ? predictors_.back().get() : nullptr,
                       .present_scan_only = named.method && takes_one_scan(*named.method)});
    }
  }

  const std::vector<RegistrationMethodUse>& uses() const { return uses_; }

 private:
  std::vector<std::unique_ptr<WarpPredictor>> predictors_;
  std::vector<RegistrationMethodUse> uses_;
};

std::string error_text(const RegistrationTrial& trial) {
  return fmt::format("{:.0f} cm and {:.0f} deg off (prior {:.0f} cm, {:.0f} deg)",
                     100.0 * trial.error.position_m, deg_from_rad(trial.error.heading_rad),
                     100.0 * trial.prior.position_m, deg_from_rad(trial.prior.heading_rad));
}

RegistrationTask recorded_task(const RecordedSet& recorded, const RegistrationSuiteParams& params,
                               std::uint64_t seed) {
  const auto make = [recorded, params] {
    FilterData data = recorded.read();
    RegistrationSet set = make_registration_set(
        recorded.name, recorded.kind, std::move(data.sketch), data.run, data.reference, params.set);
    if (set.steps.empty()) {
      throw std::runtime_error(recorded.reference.string() +
                               ": has no scored pose for any scan of " + recorded.log.string());
    }
    return set;
  };
  return {
      .set = recorded.name, .make = make, .around_truth = {main_protocol(params)}, .seed = seed};
}

/// Asks questions again, to draw what came of them; remembers the drives.
class ExampleMaker {
 public:
  ExampleMaker(const std::vector<RegistrationTask>& tasks, const NamedMethod& method,
               const NetworkPredictorParams& params)
      : tasks_(tasks), predictors_({method}, params), window_(params.window) {}

  RegistrationExample operator()(const RegistrationTrial& trial) {
    const auto task = std::ranges::find(tasks_, trial.set, &RegistrationTask::set);
    auto known = sets_.find(trial.set);
    if (known == sets_.end()) {
      known = sets_.emplace(trial.set, task->make()).first;
    }
    const RegistrationSet& set = known->second;
    const RegistrationMethodUse& method = predictors_.uses().front();
    const Sim2 prior = first_prior_of(*task, set, trial.index);
    const std::optional<Registration> found = ask(set, trial.index, method, prior);
    const RegistrationStep& step = set.steps[trial.index];
    const std::vector<PlacedScan> submap = submap_for(method, step);
    return {.caption = trial.set + ", question " + std::to_string(trial.index + 1) + ": " +
                       error_text(trial),
            .svg = registration_svg({.sketch = &set.sketch,
                                     .submap = submap,
                                     .prior_sketch_from_robot = prior,
                                     .registration = found ? &*found : nullptr,
                                     .true_sketch_from_robot = step.sketch_from_robot,
                                     .window = found ? found->window : window_})};
  }

 private:
  const std::vector<RegistrationTask>& tasks_;
  Predictors predictors_;
  LocalWindow window_;  ///< shown where nothing was found
  std::map<std::string, RegistrationSet> sets_;
};

/// Runs the registration suite.
class RegistrationAblation {
 public:
  explicit RegistrationAblation(const AblateOptions& options)
      : options_(options),
        params_(suite_parameters(options.parameters)),
        methods_(methods_of(options)),
        tasks_(simulated_tasks(params_.registration, options.seed)) {
    std::size_t index = 0;
    for (const RecordedSet& recorded : recorded_sets(options)) {
      tasks_.push_back(
          recorded_task(recorded, params_.registration, make_rng(options.seed, index++)()));
    }
    std::vector<std::string> sets;
    std::ranges::transform(tasks_, std::back_inserter(sets), &RegistrationTask::set);
    check_set_names(sets);
    if (tasks_.empty() || methods_.empty()) {
      throw std::invalid_argument(
          "there is nothing to run: give --registration.plans above 0 or a --set, and a method");
    }
    Predictors(methods_, params_.filter.predictor);  // complains now, not after the first drive
  }

  RegistrationPage run() {
    std::vector<std::vector<RegistrationTrial>> of_task(tasks_.size());
    Progress progress("ablate", tasks_.size());
    work_in_parallel(
        tasks_.size(), options_.jobs, [&](std::size_t i) { of_task[i] = run_one(tasks_[i]); },
        [&](std::size_t done) { progress.update(done); });
    for (std::vector<RegistrationTrial>& trials : of_task) {
      std::ranges::move(trials, std::back_inserter(trials_));
    }
    const std::string& first = methods_.front().name;
    RegistrationPage page{.title = "Registration",
                          .caption = caption(),
                          .rows = summarize_registration(trials_, options_.seed),
                          .differences = compare_registration(trials_, first, options_.seed),
                          .typical = {},
                          .worst = {}};
    show_examples(page);
    return page;
  }

  const std::vector<RegistrationTrial>& trials() const { return trials_; }
  ConfigNode parameters() const { return suite_config(params_); }

 private:
  std::vector<RegistrationTrial> run_one(const RegistrationTask& task) const {
    const RegistrationSet set = task.make();
    const Predictors predictors(methods_, params_.filter.predictor);
    std::vector<RegistrationTrial> trials;
    for (const RegistrationMethodUse& method : predictors.uses()) {
      // Open3D has global state.
      const auto alone =
          method.name == "icp" ? std::unique_lock(icp_) : std::unique_lock<std::mutex>();
      std::ranges::move(run_task(task, set, method), std::back_inserter(trials));
    }
    return trials;
  }

  std::string caption() const {
    const RegistrationSuiteParams& params = params_.registration;
    return std::to_string(params.plans) + " simulated buildings, " + std::to_string(params.warps) +
           " drawings of each and a drive of " + std::to_string(static_cast<int>(params.drive_m)) +
           " m in each, seed " + std::to_string(options_.seed) + "; " +
           std::to_string(options_.sets.size()) +
           " recorded runs. All methods got the same scans "
           "and the same priors.";
  }

  /// Of the first method, with priors around the truth: some from the middle, and the worst of
  /// different drives.
  void show_examples(RegistrationPage& page) const {
    const std::string protocol = main_protocol(params_.registration).name;
    std::vector<const RegistrationTrial*> ordered;
    for (const RegistrationTrial& trial : trials_) {
      if (!is_swept(trial.kind, trial.protocol) && trial.method == methods_.front().name &&
          trial.protocol == protocol) {
        ordered.push_back(&trial);
      }
    }
    std::ranges::stable_sort(
        ordered, {}, [](const RegistrationTrial* trial) { return trial->error.position_m; });
    const std::size_t count = ordered.size();
    ExampleMaker make_example(tasks_, methods_.front(), params_.filter.predictor);
    for (std::size_t i = 0; i < std::min(kTypicalShown, count); ++i) {
      page.typical.push_back(make_example(*ordered[count * (2 * i + 1) / (2 * kTypicalShown)]));
    }
    std::set<std::string> shown;
    for (std::size_t i = count; i-- > 0 && shown.size() < kWorstShown;) {
      if (shown.insert(ordered[i]->set).second) {
        page.worst.push_back(make_example(*ordered[i]));
      }
    }
  }

  const AblateOptions& options_;
  AblateParams params_;
  std::vector<NamedMethod> methods_;
  std::vector<RegistrationTask> tasks_;
  std::vector<RegistrationTrial> trials_;
  mutable std::mutex icp_;
};

}  // namespace

void run_registration_suite(const AblateOptions& options) {
  if (processes_started() > 1) {
    throw std::invalid_argument("--suite registration runs in one process; leave out mpirun");
  }
  OutputFolder out(options.out, options.force);
  RegistrationAblation ablation(options);
  const RegistrationPage page = ablation.run();
  write_atomically(out / "report.html", registration_page_html(page));
  write_atomically(out / "metrics.json", registration_json(page.rows, page.differences));
  write_atomically(out / "timing.json", registration_timing_json(page.rows));
  write_atomically(out / "trials.csv", trials_csv(ablation.trials()));
  write_atomically(out / "run.yaml", run_file_text(description_of(options, ablation.parameters())));
  out.commit();
  std::cout << registration_markdown(page.rows)
            << "report: " << (out.target() / "report.html").string() << "\n";
}

}  // namespace sketchloc
