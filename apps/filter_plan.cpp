#include "apps/filter_plan.hpp"

#include <algorithm>
#include <iterator>
#include <mutex>
#include <set>
#include <stdexcept>

#include "apps/fingerprint.hpp"
#include "apps/given_network.hpp"
#include "apps/option_checks.hpp"
#include "eval/lost_drives.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

/// What was given for the method's registration.
fs::path network_given(const AblateOptions& options, const LocalizationMethod& method) {
  return network_given(options, name_of(registration_methods(), *method.registration));
}

std::vector<LocalizationMethod> methods_of(const AblateOptions& options) {
  std::vector<LocalizationMethod> wanted;
  if (options.methods.empty()) {
    std::ranges::copy(localization_methods(), std::back_inserter(wanted));
  }
  for (const std::string& name : options.methods) {
    wanted.push_back(localization_method(name));
  }
  std::erase_if(wanted, [&](const LocalizationMethod& method) {
    return method.registration &&
           !can_run(*method.registration, method.name, network_given(options, method));
  });
  return wanted;
}

FilterTask recorded_task(const RecordedSet& recorded) {
  const auto data = std::make_shared<const FilterData>(recorded.read());
  check_start(recorded.name, *data);
  return {.set = recorded.name, .kind = recorded.kind, .make = [data] { return *data; }};
}

std::vector<FilterTask> tasks_of(const AblateOptions& options, const FilterSuiteParams& params) {
  std::vector<FilterTask> tasks;
  if (options.suite == "filter") {
    tasks = simulated_drives(params, options.seed);
  } else if (options.suite == "robust") {
    tasks = robust_drives(params, options.seed);
    std::ranges::move(lost_drives(params, options.seed), std::back_inserter(tasks));
  }
  std::ranges::transform(recorded_sets(options), std::back_inserter(tasks), recorded_task);
  return tasks;
}

std::vector<FilterPlan::Piece> pieces_of(const FilterPlan& plan, const AblateOptions& options) {
  std::vector<FilterPlan::Piece> pieces;
  for (std::size_t task = 0; task < plan.tasks.size(); ++task) {
    for (std::size_t method = 0; method < plan.methods.size(); ++method) {
      const bool draws = plan.methods[method].method == Method::Mcl;
      if (!draws && plan.tasks[task].start == FilterStart::Anywhere) {
        continue;  // it needs a pose to go on from
      }
      for (int i = 0; i < (draws ? options.seeds : 1); ++i) {
        pieces.push_back(
            {.task = task, .method = method, .seed = options.seed + static_cast<std::uint64_t>(i)});
      }
    }
  }
  return pieces;
}

/// Throws std::invalid_argument where two have one name.
void check_names(const FilterPlan& plan) {
  std::vector<std::string> sets;
  std::ranges::transform(plan.tasks, std::back_inserter(sets), &FilterTask::set);
  check_set_names(sets);
  std::set<std::string> names;
  for (const LocalizationMethod& method : plan.methods) {
    if (!names.insert(method.name).second) {
      throw std::invalid_argument("--methods: " + method.name + " is there twice");
    }
  }
}

std::map<RegistrationMethod, fs::path> networks_given(const AblateOptions& options) {
  std::map<RegistrationMethod, fs::path> networks;
  for (const auto& [name, method] : registration_methods()) {
    networks[method] = network_given(options, name);
  }
  return networks;
}

}  // namespace

std::string FilterPlan::name_of(const Piece& piece) const {
  return tasks.at(piece.task).set + ", " + methods.at(piece.method).name + ", " +
         std::to_string(piece.seed);
}

std::unique_ptr<WarpPredictor> FilterPlan::predictor(RegistrationMethod method) const {
  return predictor_from(method, networks.at(method), params.filter.predictor);
}

FilterPlan filter_plan(const AblateOptions& options) {
  FilterPlan plan{.params = suite_parameters(options.parameters),
                  .methods = methods_of(options),
                  .tasks = {},
                  .pieces = {},
                  .networks = networks_given(options)};
  validate(plan.params.filter);
  plan.params.filter.localizer.jobs = 1;  // runs stand side by side
  plan.tasks = tasks_of(options, plan.params.drives);
  if (plan.tasks.empty() || plan.methods.empty()) {
    throw std::invalid_argument(
        "there is nothing to run: give a --set" +
        std::string(options.suite == "real" ? "" : ", or --drives.plans above 0, and a method"));
  }
  check_names(plan);
  for (const LocalizationMethod& method : plan.methods) {
    if (method.registration) {
      plan.predictor(*method.registration);  // it says what is wrong with the network
    }
  }
  plan.pieces = pieces_of(plan, options);
  return plan;
}

std::string fingerprints_of(const AblateOptions& options, const FilterPlan& plan) {
  std::string text = "program: " + fingerprint_of_file("/proc/self/exe") + "\n";
  const auto add = [&](const fs::path& file) {
    text += file.empty() ? "" : file.string() + ": " + fingerprint_of_file(file) + "\n";
  };
  for (const auto& [method, network] : plan.networks) {
    add(network);
  }
  for (const RecordedSet& recorded : recorded_sets(options)) {
    for (const fs::path& file :
         {recorded.drawing, recorded.log, recorded.reference, recorded.alternative}) {
      add(file);
    }
    // A map's YAML names its picture.
    const auto task = std::ranges::find(plan.tasks, recorded.name, &FilterTask::set);
    const FilterData data = task->make();
    text +=
        "as read: " + fingerprint(std::as_bytes(std::span(data.sketch.occupied.cells()))) + "\n";
  }
  return text;
}

FilterTrial FilterWorker::run(const FilterPlan::Piece& piece) {
  static std::mutex icp;  // Open3D has global state
  const LocalizationMethod& method = plan_.methods.at(piece.method);
  const auto alone = method.registration == RegistrationMethod::Icp
                         ? std::unique_lock(icp)
                         : std::unique_lock<std::mutex>();
  return run_filter_trial(plan_.tasks.at(piece.task), data_of(piece.task), method,
                          plan_.params.filter, piece.seed, predictor_of(method));
}

const FilterData& FilterWorker::data_of(std::size_t task) {
  if (task_ != task) {
    data_ = plan_.tasks.at(task).make();
    task_ = task;
  }
  return data_;
}

WarpPredictor* FilterWorker::predictor_of(const LocalizationMethod& method) {
  if (!method.registration) {
    return nullptr;
  }
  std::unique_ptr<WarpPredictor>& predictor = predictors_[*method.registration];
  if (!predictor) {
    predictor = plan_.predictor(*method.registration);
  }
  return predictor.get();
}

}  // namespace sketchloc
