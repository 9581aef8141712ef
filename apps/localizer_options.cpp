#include "apps/localizer_options.hpp"

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "apps/given_network.hpp"
#include "apps/option_checks.hpp"
#include "apps/program.hpp"
#include "apps/start_pose.hpp"

namespace sketchloc {

/// What the command line says replaces any other of a --config file.
void add_start_options(CLI::App& command, StartOptions& start, const std::string& reference) {
  CLI::Option* pose =
      command
          .add_option("--start", start.pose,
                      "Where the robot starts in the drawing: x right and y up from the lower left "
                      "corner in px, heading counter-clockwise")
          ->check([](const std::string& text) { return parse_start_pose(text), std::string(); })
          ->group(kAlgorithmGroup)
          ->type_name("X,Y,HEADING_DEG[,PX_PER_M]");
  CLI::Option* from_reference = command
                                    .add_flag("--start-from-reference", start.from_reference,
                                              "Start at the first pose of " + reference)
                                    ->group(kAlgorithmGroup);
  CLI::Option* anywhere =
      command.add_flag("--global", start.anywhere, "Start anywhere in the drawing (default)")
          ->group(kAlgorithmGroup);
  pose->excludes(from_reference)->excludes(anywhere);
  from_reference->excludes(anywhere);
}

void add_method_options(CLI::App& command, MethodOptions& options,
                        const std::vector<std::string>& names) {
  command
      .add_option("--method", options.name,
                  "What finds the robot: the filter, helped by registrations (ours) or alone "
                  "(mcl), or another row of the ablation; default: ours in drawings, mcl on maps "
                  "in true proportions")
      ->check(one_of(names))
      ->group(kAlgorithmGroup)
      ->type_name("NAME");
  command
      .add_option("--network", options.network,
                  "A network that sketchloc train made, instead of the one that comes with the "
                  "program")
      ->group(kAlgorithmGroup)
      ->type_name("FILE.onnx");
  add_named_option(command, "--odometry", options.odometry, odometry_sources(),
                   "matched (refined by scan matching) or raw")
      ->group(kAlgorithmGroup);
  command
      .add_option("--seed", options.seed, "Of all randomness; the same seed gives the same result")
      ->check(whole_number())
      ->group(kAlgorithmGroup)
      ->capture_default_str();
}

const std::map<std::string, OdometrySource>& odometry_sources() {
  static const std::map<std::string, OdometrySource> kSources = {
      {"matched", OdometrySource::Matched}, {"raw", OdometrySource::Raw}};
  return kSources;
}

const LocalizationMethod& method_of(const MethodOptions& options, const Sketch& sketch) {
  const std::string best = sketch.px_per_m ? "mcl" : "ours";
  return localization_method(options.name.empty() ? best : options.name);
}

std::unique_ptr<WarpPredictor> predictor_of(const LocalizationMethod& method,
                                            const MethodOptions& options,
                                            const NetworkPredictorParams& params) {
  if (!method.registration) {
    if (!options.network.empty()) {
      throw std::invalid_argument("--method " + method.name +
                                  " runs no network; leave out --network");
    }
    return nullptr;
  }
  run_networks_on_one_thread();
  return predictor_from(*method.registration, options.network, params);
}

}  // namespace sketchloc
