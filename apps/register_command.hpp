#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "apps/parameter_options.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_io.hpp"
#include "eval/predictors.hpp"
#include "registration/matched_odometry.hpp"
#include "registration/recent_scans.hpp"

namespace CLI {
class App;
}

namespace sketchloc {

struct RegisterParams {
  NetworkPredictorParams predictor;
  RecentScansParams submap;
  MatchedOdometryParams odometry;  ///< places the scans of the submap
};

template <typename Visitor>
void visit_fields(RegisterParams& params, Visitor&& visit) {
  visit("predictor", params.predictor);
  visit("submap", params.submap);
  visit("odometry", params.odometry);
}

/// What `sketchloc register` is told.
struct RegisterOptions {
  std::filesystem::path map;
  std::filesystem::path log;
  std::optional<std::size_t> scan;  ///< index in the log; neither it nor a time: the first one
  std::optional<double> time_s;     ///< the scan nearest to it; not together with `scan`
  std::string prior;                ///< "X,Y,HEADING_DEG[,PX_PER_M]" in the sketch frame
  RegistrationMethod method = RegistrationMethod::Ours;
  std::filesystem::path network;  ///< ONNX; empty: the one that comes with the program
  bool single_scan = false;

  RunReading reading;     ///< of the log
  SketchReading drawing;  ///< of the map
  ParameterOptions parameters;

  std::filesystem::path reference;           ///< empty: none
  std::optional<std::filesystem::path> out;  ///< none: nothing is written
  bool force = false;
  bool json = false;  ///< on stdout, instead of lines for people
};

/// Registers one scan, or the submap that ends with it, in a drawing. Throws std::invalid_argument
/// for options that make no sense, std::runtime_error where the data fail.
void run_register(const RegisterOptions& options);

void add_register_command(CLI::App& program);

}  // namespace sketchloc
