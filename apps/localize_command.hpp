#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/localizer_options.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_io.hpp"

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

  StartOptions start;
  MethodOptions method;
  Smoothing smoothing = Smoothing::None;

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
