#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "apps/parameter_options.hpp"
#include "motion/graph/incremental.hpp"
#include "motion/graph/optimise.hpp"
#include "smoothing/drawing_spline.hpp"
#include "smoothing/smoothing_params.hpp"

namespace CLI {
class App;
}

namespace sketchloc {

/// Where the poses of a graph come from, before anything is smoothed.
enum class GraphPoses {
  Given,     ///< the file
  Odometry,  ///< dead reckoning along the steps: what the file says of poses is not used
};

struct SmoothParams {
  OptimiseParams optimise;
  IncrementalParams incremental;  ///< with --incremental
  SmoothingParams smoothing;      ///< of a run
  DrawingSplineParams spline;     ///< of the whole drawing, from a run
};

template <typename Visitor>
void visit_fields(SmoothParams& params, Visitor&& visit) {
  visit("optimise", params.optimise);
  visit("incremental", params.incremental);
  visit("smoothing", params.smoothing);
  visit("spline", params.spline);
}

/// What `sketchloc smooth` is told.
struct SmoothOptions {
  std::filesystem::path run;    ///< folder of a run in a drawing; or else
  std::filesystem::path graph;  ///< a graph
  GraphPoses start = GraphPoses::Given;
  std::optional<KernelShape> kernel;  ///< wins over the parameters
  bool incremental = false;           ///< vertex by vertex, in the order of the file
  double wrong_loops = 0.0;           ///< share of all loop closures, added
  std::uint64_t seed = 1;             ///< of the wrong ones
  ParameterOptions parameters;

  std::filesystem::path reference;  ///< a graph to compare with; empty: none
  std::filesystem::path out;
  bool force = false;
};

/// Throws std::invalid_argument for options that make no sense, std::runtime_error where the data
/// fail or do not determine the poses.
void run_smooth(const SmoothOptions& options);

void add_smooth_command(CLI::App& program);

}  // namespace sketchloc
