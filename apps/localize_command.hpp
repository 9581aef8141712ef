#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/parameter_options.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_io.hpp"
#include "eval/localization.hpp"

namespace CLI {
class App;
}

namespace sketchloc {

/// What `sketchloc localize` is told.
struct LocalizeOptions {
  std::filesystem::path map;
  std::filesystem::path log;
  std::filesystem::path out;
  std::filesystem::path reference;  ///< empty: none
  std::vector<std::filesystem::path> alternatives;

  std::string start;  ///< "X,Y,HEADING_DEG[,PX_PER_M]" in the sketch frame; empty: none
  bool start_from_reference = false;
  bool global = false;

  Method method = Method::Mcl;
  OdometrySource odometry = OdometrySource::Matched;
  std::string registration = "none";  ///< or the name of a RegistrationMethod
  std::filesystem::path network;      ///< of the registration; empty: the one that comes with it
  std::uint64_t seed = 1;
  unsigned jobs = 1;  ///< threads; 0: one per core

  RunReading reading;     ///< of the log
  SketchReading drawing;  ///< of the map
  bool force = false;
  std::string title;  ///< of the report; empty: names of drawing and log
  ParameterOptions parameters;
};

/// Localizes a log in a drawing and writes the folder of results. Throws std::invalid_argument for
/// options that do not fit together, std::runtime_error where the data fail.
void run_localize(const LocalizeOptions& options);

void add_localize_command(CLI::App& program);

}  // namespace sketchloc
