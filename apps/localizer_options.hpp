#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/parallel.hpp"
#include "apps/parameter_options.hpp"
#include "datasets/sketch.hpp"
#include "eval/localization_methods.hpp"

namespace CLI {
class App;
}

namespace sketchloc {

// What the commands share that find a robot in a drawing.

/// Where the robot starts; at most one of them.
struct StartOptions {
  std::string pose;             ///< "X,Y,HEADING_DEG[,PX_PER_M]" in the sketch frame; empty: none
  bool from_reference = false;  ///< at the reference's first pose
  bool anywhere = false;        ///< the default

  bool has_pose() const { return !pose.empty() || from_reference; }
};

/// `reference`: whose first pose it is, for people.
void add_start_options(CLI::App& command, StartOptions& start, const std::string& reference);

/// What finds the robot.
struct MethodOptions {
  std::string name;               ///< of a LocalizationMethod; empty: the best for the drawing
  std::filesystem::path network;  ///< of its registration; empty: the one that comes with it
  OdometrySource odometry = OdometrySource::Matched;
  std::uint64_t seed = 1;
  unsigned jobs = 1;  ///< threads; 0: one per core
};

/// --method (one of `names`), --network, --odometry and --seed.
void add_method_options(CLI::App& command, MethodOptions& options,
                        const std::vector<std::string>& names);

const std::map<std::string, OdometrySource>& odometry_sources();

/// The method that was asked for. By default the filter, helped by registrations in a drawing, but
/// not on a map in true proportions, where the filter alone is far more exact than they are.
const LocalizationMethod& method_of(const MethodOptions& options, const Sketch& sketch);

/// What registers scans for the method; none: nothing does. Throws std::invalid_argument where a
/// network is given to a method that runs none, and as predictor_from does.
std::unique_ptr<WarpPredictor> predictor_of(const LocalizationMethod& method,
                                            const MethodOptions& options,
                                            const NetworkPredictorParams& params);

/// The defaults of parameters with a localizer: a map in true proportions has others than a
/// drawing.
template <typename Params>
Params defaults_for(const Sketch& sketch) {
  Params defaults;
  if (sketch.px_per_m) {
    defaults.localizer = metric_localizer_params();
  }
  return defaults;
}

/// The parameters that hold: what was given, over the defaults for the drawing.
template <typename Params>
Params parameters_for(const Sketch& sketch, const ParameterOptions& given,
                      const MethodOptions& options) {
  Params params = parameters_from<Params>(given, defaults_for<Params>(sketch));
  params.localizer.seed = options.seed;
  params.localizer.jobs = static_cast<int>(std::min(thread_count(options.jobs), 1024U));
  validate(params);
  return params;
}

}  // namespace sketchloc
