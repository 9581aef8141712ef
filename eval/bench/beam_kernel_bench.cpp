#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "eval/bench/particle_window.hpp"
#include "filter/beam_kernel.hpp"
#include "tests/support/grids.hpp"
#include "tests/support/scalar_beam_model.hpp"

namespace sketchloc {
namespace {

constexpr double kScale = 20.0;

std::vector<Beam> scan(std::int64_t beams) {
  std::vector<Beam> scan;
  for (std::int64_t i = 0; i < beams; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(beams);
    scan.push_back({.bearing_rad = std::numbers::pi_v<float> * (share - 0.5F),
                    .range_m = 1.0F + 6.0F * std::abs(std::sin(9.0F * share)),
                    .returned = i % 16 != 5});
  }
  return scan;
}

Grid<std::uint8_t> drawing(std::int64_t size) {
  return testing::thin_strokes(static_cast<int>(size), static_cast<int>(size),
                               static_cast<int>(size) / 10, 1);
}

void count_rays(benchmark::State& state, std::int64_t rays_per_iteration) {
  state.counters["rays"] = benchmark::Counter(
      static_cast<double>(rays_per_iteration * state.iterations()), benchmark::Counter::kIsRate);
}

/// Arguments: particles, beams, side of the drawing, spread (1) or tracking (0).
void ByTraversal(benchmark::State& state) {
  const Grid<std::uint8_t> occupied = drawing(state.range(2));
  bench::ParticleWindow window(state.range(0), state.range(2), state.range(3) != 0, kScale);
  const std::vector<Beam> beams = scan(state.range(1));
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        testing::score_by_traversal(occupied, {}, window.next(), beams, 1000.0));
  }
  count_rays(state, state.range(0) * state.range(1));
}
BENCHMARK(ByTraversal)
    ->Args({2000, 60, 1000, 1})
    ->Args({2000, 60, 1000, 0})
    ->Unit(benchmark::kMicrosecond);

void Score(benchmark::State& state) {
  const RangeTable table(drawing(state.range(2)));
  const BeamKernel kernel(table, BeamKernelParams{});
  bench::ParticleWindow window(state.range(0), state.range(2), state.range(3) != 0, kScale);
  PreparedBeams beams;
  kernel.prepare(scan(state.range(1)), beams);
  std::vector<float> scores(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    kernel.score(window.next(), beams, scores);
    benchmark::DoNotOptimize(scores.data());
    benchmark::ClobberMemory();
  }
  count_rays(state, state.range(0) * state.range(1));
}
BENCHMARK(Score)
    ->Args({2000, 60, 1000, 1})
    ->Args({2000, 60, 1000, 0})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(Score)
    ->ArgsProduct({{10000}, {60}, {400, 1000, 2000}, {1, 0}})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(Score)
    ->ArgsProduct({{500, 1000, 4000, 8000, 16000}, {60}, {1000}, {1}})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(Score)
    ->ArgsProduct({{2000}, {30, 64, 128, 180, 360, 720}, {1000}, {1}})
    ->Unit(benchmark::kMicrosecond);

/// As Score, with particles that are not similarities.
void ScoreStrained(benchmark::State& state) {
  const RangeTable table(drawing(state.range(2)));
  const BeamKernel kernel(table, BeamKernelParams{.nothing_drawn = -0.8});
  bench::ParticleWindow window(state.range(0), state.range(2), state.range(3) != 0, kScale, true);
  PreparedBeams beams;
  kernel.prepare(scan(state.range(1)), beams);
  std::vector<float> scores(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    kernel.score(window.next(), beams, scores);
    benchmark::DoNotOptimize(scores.data());
    benchmark::ClobberMemory();
  }
  count_rays(state, state.range(0) * state.range(1));
}
BENCHMARK(ScoreStrained)
    ->ArgsProduct({{2000}, {60}, {1000}, {1, 0}})
    ->Unit(benchmark::kMicrosecond);

/// Not a time: how far the kernel's scores are from the traversal's, per beam. Arguments as above.
void ErrorAgainstTraversal(benchmark::State& state) {
  const Grid<std::uint8_t> occupied = drawing(state.range(2));
  const RangeTable table(occupied);
  const BeamKernel kernel(table, BeamKernelParams{});
  bench::ParticleWindow window(state.range(0), state.range(2), state.range(3) != 0, kScale);
  const ParticleSpans particles = window.next();
  const std::vector<Beam> beams = scan(state.range(1));
  PreparedBeams prepared;
  kernel.prepare(beams, prepared);
  std::vector<float> scores(particles.size());
  std::vector<double> exact;
  for (auto _ : state) {
    kernel.score(particles, prepared, scores);
    exact = testing::score_by_traversal(occupied, {}, particles, beams, table.max_range_px());
  }
  double squares = 0.0;
  double worst = 0.0;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    const double error = (scores[i] - exact[i]) / static_cast<double>(beams.size());
    squares += error * error;
    worst = std::max(worst, std::abs(error));
  }
  state.counters["rms"] = std::sqrt(squares / static_cast<double>(scores.size()));
  state.counters["max"] = worst;
}
BENCHMARK(ErrorAgainstTraversal)
    ->ArgsProduct({{10000}, {60}, {1000}, {1, 0}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

void Prepare(benchmark::State& state) {
  const RangeTable table(drawing(100));
  const BeamKernel kernel(table, BeamKernelParams{});
  const std::vector<Beam> beams = scan(state.range(0));
  PreparedBeams prepared;
  for (auto _ : state) {
    kernel.prepare(beams, prepared);
    benchmark::DoNotOptimize(prepared);
  }
}
BENCHMARK(Prepare)->Arg(60)->Arg(360);

}  // namespace
}  // namespace sketchloc
