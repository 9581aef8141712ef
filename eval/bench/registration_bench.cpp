#include <benchmark/benchmark.h>

#include <memory>
#include <vector>

#include "datasets/sim/person.hpp"
#include "eval/registration_set.hpp"
#include "eval/simulated_drive.hpp"
#include "motion/angles.hpp"
#include "registration/network_predictor.hpp"
#include "registration/shipped_networks.hpp"

namespace sketchloc {
namespace {

/// Questions in a drawing as people draw, with the scans of the last metres.
const RegistrationSet& questions() {
  static const RegistrationSet set = make_registration_set(
      "bench", "human",
      simulated_drive({.suite = 0xBE4C4, .plan = 1},
                      {.person = human_person(), .drive = {.length_m = 20.0}}, 1));
  return set;
}

/// A whole registration: rasters, crops, network, splines; on one thread. Arguments: priors, looks.
void registration(benchmark::State& state, NetworkKind kind) {
  run_networks_on_one_thread();
  if (shipped_network(kind).empty()) {
    state.SkipWithError("no such network comes with the program");
    return;
  }
  const auto predictor = make_network_predictor(
      shipped_network(kind), kind, {.window = {}, .looks = static_cast<int>(state.range(1))});
  const RegistrationSet& set = questions();
  std::size_t next = 0;
  for (auto _ : state) {
    const RegistrationStep& step = set.steps[next++ % set.steps.size()];
    std::vector<Sim2> priors;
    for (int i = 0; i < state.range(0); ++i) {
      priors.push_back(step.sketch_from_robot *
                       Sim2::from_xy_yaw_scale(0.3 * i, 0.5, rad_from_deg(5.0), 1.05));
    }
    benchmark::DoNotOptimize(predictor->predict(step.submap(), set.drawing, priors));
  }
}

BENCHMARK_CAPTURE(registration, ours, NetworkKind::Ours)
    ->ArgNames({"priors", "looks"})
    ->ArgsProduct({{1, 4}, {1, 2}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(registration, chen20, NetworkKind::Chen20)
    ->ArgNames({"priors", "looks"})
    ->ArgsProduct({{1, 4}, {1}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sketchloc
