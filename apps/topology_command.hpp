#pragma once

#include <filesystem>

#include "apps/labelled_run.hpp"
#include "apps/parameter_options.hpp"
#include "topology/recovered_run.hpp"

namespace CLI {
class App;
}

namespace sketchloc {

/// What `sketchloc topology` is told.
struct TopologyOptions {
  LabelledRunFiles files;
  bool incremental = false;  ///< node by node, as if the robot were driving
  TopologyStage stage = TopologyStage::Feedback;
  ParameterOptions parameters;

  std::filesystem::path out;
  bool force = false;
};

/// Throws std::invalid_argument for options that make no sense, std::runtime_error where the data
/// fail.
void run_topology(const TopologyOptions& options);

void add_topology_command(CLI::App& program);

}  // namespace sketchloc
