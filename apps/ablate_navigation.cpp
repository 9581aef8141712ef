#include <spdlog/spdlog.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "apps/ablate_suites.hpp"
#include "apps/fingerprint.hpp"
#include "apps/given_network.hpp"
#include "apps/navigation_clock.hpp"
#include "apps/option_checks.hpp"
#include "apps/output_folder.hpp"
#include "apps/parallel.hpp"
#include "apps/progress.hpp"
#include "apps/ranks.hpp"
#include "apps/unfinished_work.hpp"
#include "datasets/io/atomic_file.hpp"
#include "eval/navigation_record.hpp"
#include "eval/navigation_summary.hpp"

namespace sketchloc {
namespace {

/// One task and method: what one thread does in one go.
struct Piece {
  std::string kind;
  int plan = 0;
  LocalizationMethod method;

  std::string name() const { return kind + " " + std::to_string(plan) + ", " + method.name; }
};

std::vector<LocalizationMethod> methods_of(const AblateOptions& options) {
  std::vector<std::string> names = options.methods;
  if (names.empty()) {
    names = {"icp", "affine", "chen20", "mcl", "ours"};
  }
  std::vector<LocalizationMethod> methods;
  for (const std::string& name : names) {
    const LocalizationMethod& method = localization_method(name);
    if (method.method == Method::Odometry) {
      throw std::invalid_argument(
          "--suite navigation: a robot without a drawing has no goal in it; leave out odometry");
    }
    const auto given = [&] {
      return network_given(options, name_of(registration_methods(), *method.registration));
    };
    if (!method.registration || can_run(*method.registration, name, given())) {
      methods.push_back(method);
    }
  }
  return methods;
}

std::vector<Piece> pieces_of(const AblateOptions& options, const NavigationSuiteParams& suite) {
  std::vector<Piece> pieces;
  for (const std::string kind : {"human", "tps"}) {
    for (int plan = 0; plan < (kind == "human" ? suite.plans : suite.tps_plans); ++plan) {
      for (const LocalizationMethod& method : methods_of(options)) {
        pieces.push_back({.kind = kind, .plan = plan, .method = method});
      }
    }
  }
  return pieces;
}

std::string run_piece(const Piece& piece, const AblateOptions& options,
                      const AblateParams& params) {
  static std::mutex icp;  // Open3D has global state
  const auto alone = piece.method.registration == RegistrationMethod::Icp
                         ? std::unique_lock(icp)
                         : std::unique_lock<std::mutex>();
  std::unique_ptr<WarpPredictor> predictor;
  if (const auto registration = piece.method.registration) {
    predictor = predictor_from(
        *registration, network_given(options, name_of(registration_methods(), *registration)),
        params.filter.predictor);
  }
  const NavigationTask task =
      navigation_task(piece.kind, piece.plan, params.navigation.task,
                      params.navigation.follower.body.radius_m, options.seed);
  return navigation_json(navigate(
      task, {.method = piece.method, .localization = params.filter, .predictor = predictor.get()},
      params.navigation, options.seed, navigation_clock()));
}

}  // namespace

void run_navigation_suite(const AblateOptions& options) {
  if (!options.sets.empty() || processes_started() > 1) {
    throw std::invalid_argument("--suite navigation knows no --set and runs in one process");
  }
  run_networks_on_one_thread();
  AblateParams params = suite_parameters(options.parameters);
  params.filter.localizer.jobs = 1;  // drives stand side by side
  OutputFolder out(options.out, options.force);
  const std::vector<Piece> pieces = pieces_of(options, params.navigation_suite);
  const std::string run_file = run_file_text(description_of(options, suite_config(params)));
  UnfinishedWork unfinished(options.out,
                            run_file + "program: " + fingerprint_of_file("/proc/self/exe") + "\n");
  std::vector<std::string> lines(pieces.size());
  Progress progress("ablate", pieces.size());
  work_in_parallel(
      pieces.size(), options.jobs,
      [&](std::size_t i) {
        const std::string name = pieces[i].name();
        lines[i] = unfinished.find(name).value_or("");
        if (lines[i].empty()) {
          lines[i] = run_piece(pieces[i], options, params);
          unfinished.keep(name, lines[i]);
        }
      },
      [&](std::size_t count) { progress.update(count); });
  std::vector<NavigationTrial> trials;
  std::string all;
  for (const std::string& line : lines) {
    trials.push_back(navigation_from_json(line));
    all += line;
  }
  const double success_m = params.navigation.success_m;
  write_atomically(out / "report.html", navigation_suite_html(trials, success_m, options.seed));
  write_atomically(out / "metrics.json", navigation_suite_json(trials, success_m));
  write_atomically(out / "trials.jsonl", all);
  write_atomically(out / "run.yaml", run_file);
  out.commit();
  unfinished.finish();
  std::cout << navigation_suite_markdown(trials, success_m)
            << "report: " << (out.target() / "report.html").string() << "\n";
}

}  // namespace sketchloc
