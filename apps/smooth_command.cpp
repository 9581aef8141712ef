#include "apps/smooth_command.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/option_checks.hpp"
#include "apps/output_folder.hpp"
#include "apps/program.hpp"
#include "apps/run_file.hpp"
#include "apps/smooth_run.hpp"
#include "datasets/io/atomic_file.hpp"
#include "datasets/io/g2o_io.hpp"
#include "eval/graph_record.hpp"
#include "eval/wrong_loops.hpp"
#include "motion/graph/linear_start.hpp"
#include "motion/number_text.hpp"
#include "motion/random.hpp"

namespace sketchloc {
namespace {

const std::map<std::string, GraphPoses>& start_names() {
  static const std::map<std::string, GraphPoses> kNames = {{"given", GraphPoses::Given},
                                                           {"odometry", GraphPoses::Odometry}};
  return kNames;
}

const std::map<std::string, KernelShape>& kernel_names() {
  static const auto kShapes = names_of(KernelShape{});
  static const std::map<std::string, KernelShape> kNames(kShapes.begin(), kShapes.end());
  return kNames;
}

SmoothParams parameters_of(const SmoothOptions& options) {
  auto params = parameters_from<SmoothParams>(options.parameters);
  params.optimise.kernel.shape = options.kernel.value_or(params.optimise.kernel.shape);
  params.incremental.kernel.shape = options.kernel.value_or(params.incremental.kernel.shape);
  if (options.incremental && params.incremental.kernel.shape == KernelShape::Graduated) {
    throw std::invalid_argument(
        "--kernel graduated needs the whole graph: leave out --incremental, or choose dcs");
  }
  return params;
}

PoseGraph read_graph(const SmoothOptions& options) {
  PoseGraph graph = read_g2o(options.graph);
  if (options.start == GraphPoses::Odometry) {
    graph = with_poses(graph, dead_reckoning(graph));
  }
  Rng rng = make_rng(options.seed);
  return options.wrong_loops > 0.0 ? with_wrong_loops(std::move(graph), options.wrong_loops, rng)
                                   : graph;
}

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// The edges of each vertex to those before it.
std::vector<std::vector<GraphEdge>> edges_by_later_vertex(const PoseGraph& graph) {
  std::vector<std::vector<GraphEdge>> edges(graph.vertices.size());
  for (const GraphEdge& edge : graph.edges) {
    edges[std::max(edge.first, edge.second)].push_back(edge);
  }
  return edges;
}

/// As if the graph came vertex by vertex.
void smooth_growing(GraphRecord& record, const IncrementalParams& params) {
  IncrementalSmoother smoother(params);
  GrowingRecord growing;
  const auto edges = edges_by_later_vertex(record.before);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Clock::time_point begin = Clock::now();
    smoother.add(record.before.vertices[i]);
    for (const GraphEdge& edge : edges[i]) {
      smoother.add(edge);
    }
    const bool is_batch = smoother.update() == IncrementalSmoother::Update::Batch;
    const double update_s = seconds_since(begin);
    growing.batches += is_batch ? 1U : 0U;
    growing.mean_update_s += update_s / static_cast<double>(edges.size());
    growing.worst_update_s = std::max(growing.worst_update_s, update_s);
    ++growing.updates;
  }
  growing.chi2_before_finish = chi2(smoother.graph());
  record.result.status = smoother.finish();
  record.result.poses.clear();
  for (const GraphVertex& vertex : smoother.graph().vertices) {
    record.result.poses.push_back(vertex.frame_from_body);
  }
  record.result.start_chi2 = chi2(record.before);
  record.result.chi2 = chi2(smoother.graph());
  record.growing = growing;
}

/// What a growing graph does not count: the cost behind the kernel, and the weights.
void complete(GraphRecord& record) {
  const std::vector<double> chi2s = chi2_of_edges(record.after);
  record.result.cost = 0.0;
  record.result.weights.assign(chi2s.size(), 1.0);
  for (std::size_t i = 0; i < chi2s.size(); ++i) {
    const bool is_doubted = record.before.edges[i].may_be_wrong;
    record.result.cost += is_doubted ? robust_cost(record.params.kernel, chi2s[i]) : chi2s[i];
    record.result.weights[i] = is_doubted ? robust_weight(record.params.kernel, chi2s[i]) : 1.0;
  }
}

GraphRecord smoothed(const SmoothOptions& options, const SmoothParams& params) {
  GraphRecord record{.before = read_graph(options), .params = params.optimise};
  record.params.kernel = options.incremental ? params.incremental.kernel : params.optimise.kernel;
  const Clock::time_point begin = Clock::now();
  if (options.incremental) {
    smooth_growing(record, params.incremental);
  } else {
    record.result = optimise(record.before, params.optimise);
  }
  record.seconds = seconds_since(begin);
  record.start_chi2 = record.result.start_chi2;
  record.after = with_poses(record.before, record.result.poses);
  if (options.incremental) {
    complete(record);
  }
  if (!options.reference.empty()) {
    record.rmse_m = position_rmse_m(record.after, read_g2o(options.reference));
  }
  return record;
}

void warn_of_status(const GraphRecord& record, const SmoothOptions& options) {
  if (record.result.status == OptimiseResult::Status::Singular) {
    throw std::runtime_error(options.graph.string() +
                             ": the edges do not determine the poses; give every edge an "
                             "information without zeros on its diagonal");
  }
  if (record.result.status == OptimiseResult::Status::IterationLimit) {
    spdlog::warn("{}: not converged after {} iterations; give more --optimise.most_iterations",
                 options.graph.string(), record.result.iterations);
  }
}

RunDescription description_of(const SmoothOptions& options, const SmoothParams& params) {
  RunDescription description{.command = "smooth",
                             .seed = std::nullopt,
                             .inputs = {{"graph", options.graph.string()},
                                        {"start", name_of(start_names(), options.start)}},
                             .parameters = to_config(params)};
  if (options.incremental) {
    description.inputs.emplace_back("incremental", "true");
  }
  if (options.wrong_loops > 0.0) {
    description.seed = options.seed;
    description.inputs.emplace_back("wrong-loops", number_text(options.wrong_loops));
  }
  if (!options.reference.empty()) {
    description.inputs.emplace_back("reference", options.reference.string());
  }
  return description;
}

std::string summary_text(const GraphRecord& record) {
  std::string text =
      fmt::format("{} vertices, {} edges: chi2 {:.6g} -> {:.6g}, {}\n",
                  record.before.vertices.size(), record.before.edges.size(), record.start_chi2,
                  record.result.chi2, name_of(record.result.status));
  if (record.params.kernel.shape != KernelShape::None) {
    text += fmt::format("behind the kernel {:.6g}; {} of {} loop closures taken for wrong\n",
                        record.result.cost, rejected_edges(record), doubted_edges(record));
  }
  if (record.growing) {
    text += fmt::format("{} updates, {} of the whole graph, {:.2f} ms each in the mean\n",
                        record.growing->updates, record.growing->batches,
                        1e3 * record.growing->mean_update_s);
  }
  if (record.rmse_m) {
    text += fmt::format("positions {:.3f} m (RMS) from the reference\n", *record.rmse_m);
  }
  return text + fmt::format("{} iterations, {:.3f} s\n", record.result.iterations, record.seconds);
}

}  // namespace

void run_smooth(const SmoothOptions& options) {
  if (options.run.empty() == options.graph.empty()) {
    throw std::invalid_argument("give the folder of a run, or --graph IN.g2o");
  }
  const SmoothParams params = parameters_of(options);
  if (!options.run.empty()) {
    smooth_run(options, params);
    return;
  }
  OutputFolder out(options.out, options.force);
  const GraphRecord record = smoothed(options, params);
  warn_of_status(record, options);
  write_g2o(out / "graph.g2o", record.after);
  write_atomically(out / "metrics.json", to_json(record));
  write_atomically(out / "picture.png", picture_png(record));
  write_atomically(out / "run.yaml", run_file_text(description_of(options, params)));
  out.commit();
  std::cout << summary_text(record) << "picture: " << (out.target() / "picture.png").string()
            << "\n";
}

void add_smooth_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "smooth", "Move the poses of a run or a graph to where all agrees best.");
  const auto options = std::make_shared<SmoothOptions>();
  command
      ->add_option("run,--run", options->run,
                   "What sketchloc localize --smooth wrote: the poses of its keyframes are found "
                   "anew, from keyframes.jsonl alone")
      ->type_name("RUN_DIR")
      ->group(kAlgorithmGroup);
  command
      ->add_option("--graph", options->graph,
                   "Poses and relative poses between them: VERTEX_SE2, EDGE_SE2; plain or gzip")
      ->type_name("IN.g2o")
      ->group(kAlgorithmGroup);
  add_named_option(*command, "--start", options->start, start_names(),
                   "given: the poses of the file; odometry: dead reckoning along the edges between "
                   "neighbours")
      ->group(kAlgorithmGroup);
  add_checked_option(*command, "--kernel",
                     "What a loop closure may cost that disagrees: none (default), huber, cauchy, "
                     "dcs, graduated",
                     one_of(kernel_names()),
                     [options = options.get()](const std::string& name) {
                       options->kernel = kernel_names().at(name);
                     })
      ->group(kAlgorithmGroup);
  command
      ->add_flag("--incremental", options->incremental,
                 "Vertex by vertex, as if they came one after the other")
      ->group(kAlgorithmGroup);
  add_parameter_options(*command, to_config(SmoothParams{}), options->parameters);
  command
      ->add_option("--wrong-loops", options->wrong_loops,
                   "Add wrong loop closures until they are this share of all, to see what a kernel "
                   "makes of them")
      ->check(non_negative_number())
      ->check([](const std::string& text) {
        return parse_number<double>(text).value_or(0.0) < 1.0 ? "" : "must be below 1";
      })
      ->type_name("SHARE")
      ->group(kAlgorithmGroup);
  command->add_option("--seed", options->seed, "Of the wrong ones")
      ->check(whole_number())
      ->group(kAlgorithmGroup);
  command->add_option("--reference", options->reference, "A graph to compare the positions with")
      ->type_name("REF.g2o")
      ->group(kOutputGroup);
  command
      ->add_option("--out", options->out,
                   "Folder for graph.g2o, metrics.json and picture.png, or for the trajectory of a "
                   "run; and run.yaml")
      ->required()
      ->type_name("DIR")
      ->group(kOutputGroup);
  command->add_flag("--force", options->force, "Replace an earlier result")->group(kOutputGroup);
  command->callback([options] { run_smooth(*options); });
}

}  // namespace sketchloc
