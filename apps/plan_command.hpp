#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "apps/parameter_options.hpp"
#include "datasets/io/sketch_io.hpp"
#include "planning/planner.hpp"

namespace CLI {
class App;
}

namespace sketchloc {

struct PlanCommandParams {
  PlanParams planning;
  ScaleFieldParams scales;  ///< of --scales
};

template <typename Visitor>
void visit_fields(PlanCommandParams& params, Visitor&& visit) {
  visit("planning", params.planning);
  visit("scales", params.scales);
}

/// What `sketchloc plan` is told.
struct PlanOptions {
  std::filesystem::path map;
  std::string start;             ///< "X,Y[,HEADING_DEG[,PX_PER_M]]" in the sketch frame
  std::string goal;              ///< "X,Y[,HEADING_DEG]"
  std::filesystem::path scales;  ///< trajectory.csv of a localized run; empty: none
  double deadline_ms = 100.0;    ///< 0: none
  std::uint64_t seed = 1;

  SketchReading drawing;  ///< of the map
  ParameterOptions parameters;

  std::filesystem::path out;
  bool force = false;
};

/// Throws std::invalid_argument for options that make no sense, std::runtime_error where the data
/// fail or where there is no way: then after its result is written.
void run_plan(const PlanOptions& options);

void add_plan_command(CLI::App& program);

}  // namespace sketchloc
