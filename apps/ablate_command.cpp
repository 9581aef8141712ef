#include "apps/ablate_command.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/given_network.hpp"
#include "apps/inputs.hpp"
#include "apps/option_checks.hpp"
#include "apps/output_folder.hpp"
#include "apps/parallel.hpp"
#include "apps/parameter_options.hpp"
#include "apps/program.hpp"
#include "apps/progress.hpp"
#include "apps/run_file.hpp"
#include "datasets/io/atomic_file.hpp"
#include "eval/predictors.hpp"
#include "eval/registration_page.hpp"
#include "eval/registration_picture.hpp"
#include "eval/registration_suite.hpp"
#include "motion/angles.hpp"
#include "registration/icp_predictor.hpp"
#include "registration/shipped_networks.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kTypicalShown = 6;
constexpr std::size_t kWorstShown = 9;

struct AblateOptions {
  std::string suite = "registration";
  std::vector<std::string> methods = {"ours", "chen20", "affine", "icp", "none"};
  std::vector<std::string> networks;
  std::vector<std::string> sets;
  std::uint64_t seed = 1;
  unsigned jobs = 0;
  fs::path out;
  bool force = false;
  ParameterOptions parameters;
};

struct AblateParams {
  RegistrationSuiteParams registration;
  NetworkPredictorParams network;
};

template <typename Visitor>
void visit_fields(AblateParams& params, Visitor&& visit) {
  visit("registration", params.registration);
  visit("network", params.network);
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == at) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// A method with its network, ready to make predictors of; `none` keeps the prior.
struct NamedMethod {
  std::string name;
  std::optional<RegistrationMethod> method;
  fs::path network;  ///< given instead of the shipped one; empty: none
};

NamedMethod method_of(const std::string& name, const AblateOptions& options) {
  NamedMethod result{.name = name, .method = {}, .network = {}};
  if (name == "none") {
    return result;
  }
  const auto names = names_of(RegistrationMethod{});
  const auto found = std::ranges::find(names, name, [](const auto& one) { return one.first; });
  if (found == names.end()) {
    throw std::invalid_argument("--methods: there is no " + name +
                                "; there are ours, chen20, affine, icp and none");
  }
  result.method = found->second;
  for (const std::string& given : options.networks) {
    const std::size_t equals = given.find('=');
    if (equals == given.npos || equals == 0) {
      throw std::invalid_argument("--network " + given + ": give METHOD=FILE.onnx");
    }
    if (given.substr(0, equals) == name) {
      result.network = given.substr(equals + 1);
    }
  }
  return result;
}

/// The methods that can run here; the others are left out with a message.
std::vector<NamedMethod> methods_of(const AblateOptions& options) {
  std::vector<NamedMethod> methods;
  for (const std::string& name : options.methods) {
    NamedMethod method = method_of(name, options);
    if (method.method == RegistrationMethod::Icp && !icp_is_built()) {
      spdlog::warn("icp is left out: this program was built without Open3D");
      continue;
    }
    const auto kind = method.method ? network_of(*method.method) : std::nullopt;
    if (kind && method.network.empty() && shipped_network(*kind).empty()) {
      spdlog::warn(
          "{} is left out: no network comes with this program; give --network {}=FILE.onnx", name,
          name);
      continue;
    }
    methods.push_back(std::move(method));
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

RegistrationTask recorded_task(const std::string& text, const RegistrationSuiteParams& params,
                               std::uint64_t seed) {
  const std::vector<std::string> parts = split(text, ',');
  if (parts.size() != 3 && parts.size() != 4) {
    throw std::invalid_argument("--set " + text + ": give DRAWING,LOG,REFERENCE.csv[,NAME]");
  }
  const std::string name = parts.size() == 4 ? parts[3] : fs::path(parts[0]).stem().string();
  const std::string kind = name.substr(0, name.find('/'));
  const auto make = [parts, name, kind, params] {
    Sketch sketch = read_drawing_input(parts[0], {});
    const Run run = read_log_input(parts[1], {});
    const Reference reference =
        read_reference_input(parts[2], sketch.height_px(), {.run = run, .log = parts[1]});
    RegistrationSet set =
        make_registration_set(name, kind, std::move(sketch), run, reference, params.set);
    if (set.steps.empty()) {
      throw std::runtime_error(parts[2] + ": has no scored pose for any scan of " + parts[1]);
    }
    return set;
  };
  return {.set = name, .make = make, .around_truth = {main_protocol(params)}, .seed = seed};
}

/// Asks questions again, to draw what came of them; remembers the drives.
class ExampleMaker {
 public:
  ExampleMaker(const std::vector<RegistrationTask>& tasks, const NamedMethod& method,
               const NetworkPredictorParams& params)
      : tasks_(tasks), predictors_({method}, params) {}

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
                                     .window = found ? found->window : LocalWindow{}})};
  }

 private:
  const std::vector<RegistrationTask>& tasks_;
  Predictors predictors_;
  std::map<std::string, RegistrationSet> sets_;
};

/// Runs the registration suite.
class RegistrationAblation {
 public:
  explicit RegistrationAblation(const AblateOptions& options)
      : options_(options),
        params_(parameters_from<AblateParams>(options.parameters)),
        methods_(methods_of(options)),
        tasks_(simulated_tasks(params_.registration, options.seed)) {
    for (std::size_t i = 0; i < options.sets.size(); ++i) {
      tasks_.push_back(
          recorded_task(options.sets[i], params_.registration, make_rng(options.seed, i)()));
    }
    check_names();
    if (tasks_.empty() || methods_.empty()) {
      throw std::invalid_argument(
          "there is nothing to run: give --registration.plans above 0 or a --set, and a method");
    }
    Predictors(methods_, params_.network);  // complains now, not after the first drive
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
  ConfigNode parameters() const { return to_config(params_); }

 private:
  /// Trials belong together by the name of their drive.
  void check_names() const {
    std::set<std::string> names;
    for (const RegistrationTask& task : tasks_) {
      if (!names.insert(task.set).second) {
        throw std::invalid_argument("--set: there are two runs of the name " + task.set +
                                    "; give DRAWING,LOG,REFERENCE.csv,NAME");
      }
    }
  }

  std::vector<RegistrationTrial> run_one(const RegistrationTask& task) const {
    const RegistrationSet set = task.make();
    const Predictors predictors(methods_, params_.network);
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
    ExampleMaker make_example(tasks_, methods_.front(), params_.network);
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

void run_ablate(const AblateOptions& options) {
  OutputFolder out(options.out, options.force);
  RegistrationAblation ablation(options);
  const RegistrationPage page = ablation.run();
  write_atomically(out / "report.html", registration_page_html(page));
  write_atomically(out / "metrics.json", registration_json(page.rows, page.differences));
  write_atomically(out / "timing.json", registration_timing_json(page.rows));
  write_atomically(out / "trials.csv", trials_csv(ablation.trials()));
  RunDescription run{.command = "ablate",
                     .seed = options.seed,
                     .inputs = {{"suite", options.suite}},
                     .parameters = ablation.parameters()};
  const auto add_all = [&](const char* option, const std::vector<std::string>& values) {
    for (const std::string& value : values) {
      run.inputs.emplace_back(option, value);
    }
  };
  add_all("methods", options.methods);
  add_all("network", options.networks);
  add_all("set", options.sets);
  write_atomically(out / "run.yaml", run_file_text(run));
  out.commit();
  std::cout << registration_markdown(page.rows)
            << "report: " << (out.target() / "report.html").string() << "\n";
}

}  // namespace

void add_ablate_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "ablate", "Compare methods on the same questions: tables with intervals, and a page.");
  const auto options = std::make_shared<AblateOptions>();
  const auto option = [&](const std::string& flag, auto& value, const std::string& help) {
    return command->add_option(flag, value, help)->group(kAlgorithmGroup);
  };
  option("--suite", options->suite, "registration: one scan or submap, one prior, one pose")
      ->check(CLI::IsMember({"registration"}))
      ->capture_default_str();
  option("--methods", options->methods,
         "Of ours, chen20, affine, icp and none (keep the prior); the first is shown in pictures")
      ->delimiter(',')
      ->capture_default_str();
  option("--network", options->networks, "Another network for a method")
      ->type_name("METHOD=FILE.onnx");
  option("--set", options->sets,
         "A recorded run to ask about as well; may be repeated; NAME as KIND/NAME puts runs of one "
         "kind into one row")
      ->type_name("DRAWING,LOG,REFERENCE.csv[,NAME]");
  option("--seed", options->seed, "Of buildings, drawings, drives and priors")
      ->check(whole_number())
      ->capture_default_str();
  add_parameter_options(*command, to_config(AblateParams{}), options->parameters);
  command->add_option("--out", options->out, "Folder of the results")
      ->required()
      ->group(kOutputGroup)
      ->type_name("DIR");
  command->add_flag("--force", options->force, "Replace an earlier result")->group(kOutputGroup);
  add_jobs_option(*command, options->jobs);
  command->callback([options] { run_ablate(*options); });
}

}  // namespace sketchloc
