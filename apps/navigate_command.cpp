#include "apps/navigate_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <stdexcept>

#include "apps/given_network.hpp"
#include "apps/navigation_clock.hpp"
#include "apps/option_checks.hpp"
#include "apps/output_folder.hpp"
#include "apps/program.hpp"
#include "apps/run_file.hpp"
#include "datasets/io/atomic_file.hpp"
#include "eval/navigation_page.hpp"
#include "eval/navigation_picture.hpp"
#include "eval/navigation_record.hpp"
#include "eval/navigation_summary.hpp"

namespace sketchloc {
namespace {

RunDescription description_of(const NavigateOptions& options, const NavigateParams& params) {
  return {.command = "navigate",
          .seed = options.seed,
          .inputs = {{"plan", std::to_string(options.plan)},
                     {"person", options.person},
                     {"method", options.method}},
          .parameters = to_config(params)};
}

std::string summary_text(const NavigationTrial& trial, double success_m) {
  return fmt::format(
      "{}: {:.2f} m from the goal after {:.1f} m, shortest {:.1f} m, {} collisions\n",
      trial.success(success_m) ? "success" : "failure", trial.error_m, trial.way_m,
      trial.shortest_m, trial.collisions);
}

}  // namespace

void run_navigate(const NavigateOptions& options) {
  const auto params = parameters_from<NavigateParams>(options.parameters);
  const LocalizationMethod& method = localization_method(options.method);
  if (method.method == Method::Odometry) {
    throw std::invalid_argument("--method odometry: it does not look at the drawing; name another");
  }
  OutputFolder out(options.out, options.force);
  std::unique_ptr<WarpPredictor> predictor;
  if (method.registration) {
    predictor = predictor_from(*method.registration, {}, params.filter.predictor);
  }
  const NavigationTask task =
      navigation_task(options.person, options.plan, params.navigation.task,
                      params.navigation.follower.body.radius_m, options.seed);
  const NavigationTrial trial = navigate(
      task, {.method = method, .localization = params.filter, .predictor = predictor.get()},
      params.navigation, options.seed, navigation_clock());
  write_atomically(out / "drive.json", navigation_json(trial));
  write_atomically(out / "picture.png", picture_png(task, trial));
  write_atomically(out / "report.html", drive_html(task, trial, params.navigation));
  write_atomically(out / "metrics.json",
                   navigation_suite_json({&trial, 1}, params.navigation.success_m));
  write_atomically(out / "run.yaml", run_file_text(description_of(options, params)));
  out.commit();
  std::cout << summary_text(trial, params.navigation.success_m)
            << "report: " << (out.target() / "report.html").string() << "\n";
}

void add_navigate_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "navigate", "Drive a simulated robot to a goal that is given in a drawing.");
  const auto options = std::make_shared<NavigateOptions>();
  const auto option = [&](const std::string& flag, auto& value, const std::string& help) {
    return command->add_option(flag, value, help)->group(kAlgorithmGroup)->capture_default_str();
  };
  option("--plan", options->plan, "Which building: by turns a home, an office, a warehouse")
      ->check(whole_number());
  option("--person", options->person, "Who drew it: human, tps")->check(one_of({"human", "tps"}));
  option("--method", options->method,
         "What finds the robot: ours, mcl, ours_chained, chen20, affine, icp");
  option("--seed", options->seed, "Of building, drawing and noise")->check(whole_number());
  add_parameter_options(*command, to_config(NavigateParams{}), options->parameters);
  command
      ->add_option("--out", options->out,
                   "Folder for report.html, drive.json, picture.png, metrics.json and run.yaml")
      ->required()
      ->type_name("DIR")
      ->group(kOutputGroup);
  command->add_flag("--force", options->force, "Replace an earlier result")->group(kOutputGroup);
  command->callback([options] { run_navigate(*options); });
}

}  // namespace sketchloc
