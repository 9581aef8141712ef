// Pose graphs of $SKETCHLOC_DATA/pose_graphs, ours and plain Ceres side by side; the median is what
// counts: --benchmark_repetitions=9 --benchmark_report_aggregates_only=true. A simulated graph
// stands in where there are no data.

#include <benchmark/benchmark.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "datasets/io/g2o_io.hpp"
#include "motion/graph/linear_start.hpp"
#include "motion/graph/optimise.hpp"
#include "tests/support/ceres_graph.hpp"
#include "tests/support/graphs.hpp"

namespace sketchloc {
namespace {

PoseGraph simulated() {
  Rng rng = make_rng(1);
  return testing::simulated_graph(3000, 0.3, rng).measured;
}

PoseGraph graph_of(const std::string& name) {
  const char* root = std::getenv("SKETCHLOC_DATA");
  return root == nullptr || name.empty()
             ? simulated()
             : read_g2o(std::filesystem::path(root) / "pose_graphs" / name);
}

void Ours(benchmark::State& state, const std::string& name, GraphStart initial) {
  const PoseGraph graph = graph_of(name);
  OptimiseParams params;
  params.initial = initial;
  OptimiseResult result;
  for (auto _ : state) {
    result = optimise(graph, params);
  }
  state.counters["chi2"] = result.chi2;
  state.counters["factorisations"] = result.iterations;
}

void PlainCeres(benchmark::State& state, const std::string& name, GraphStart initial) {
  const PoseGraph graph = graph_of(name);
  testing::CeresAnswer answer;
  for (auto _ : state) {
    const bool is_given = initial == GraphStart::Given;
    answer = testing::ceres_optimum(is_given ? graph : with_poses(graph, linear_start(graph)));
  }
  state.counters["chi2"] = answer.chi2;
  state.counters["factorisations"] = answer.iterations;
}

void register_all() {
  const bool has_data = std::getenv("SKETCHLOC_DATA") != nullptr;
  const std::vector<std::string> names =
      has_data ? std::vector<std::string>{"manhattan3500.g2o", "city10000.g2o.gz", "intel.g2o"}
               : std::vector<std::string>{""};
  for (const std::string& name : names) {
    const auto add = [&](const std::string& what, auto run) {
      benchmark::RegisterBenchmark((what + "/" + name).c_str(), run)->Unit(benchmark::kMillisecond);
    };
    add("Ours", [name](benchmark::State& state) { Ours(state, name, GraphStart::Better); });
    add("OursFromGiven", [name](benchmark::State& state) { Ours(state, name, GraphStart::Given); });
    add("PlainCeres",
        [name](benchmark::State& state) { PlainCeres(state, name, GraphStart::Given); });
    add("CeresFromLinearStart",
        [name](benchmark::State& state) { PlainCeres(state, name, GraphStart::Linear); });
  }
}

}  // namespace
}  // namespace sketchloc

int main(int argc, char** argv) {
  sketchloc::register_all();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
