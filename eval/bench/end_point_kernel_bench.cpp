#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "eval/bench/look_up_limit.hpp"
#include "eval/bench/particle_window.hpp"
#include "filter/end_point_kernel.hpp"
#include "registration/distance_field.hpp"
#include "tests/support/grids.hpp"
#include "tests/support/scalar_end_point_model.hpp"

namespace sketchloc {
namespace {

constexpr double kScale = 20.0;
constexpr EndPointParams kParams{.sigma_px = 4.0, .floor = 0.1};

struct Scan {
  std::vector<testing::PolarPoint> polar;
  std::vector<float> x_m;
  std::vector<float> y_m;

  EndPoints points() const { return {x_m, y_m}; }
};

Scan scan(std::int64_t beams) {
  Scan scan;
  for (std::int64_t i = 0; i < beams; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(beams);
    const double bearing_rad = std::numbers::pi * (share - 0.5);
    const double range_m = 1.0 + 6.0 * std::abs(std::sin(9.0 * share));
    scan.polar.push_back({bearing_rad, range_m});
    scan.x_m.push_back(static_cast<float>(range_m * std::cos(bearing_rad)));
    scan.y_m.push_back(static_cast<float>(range_m * std::sin(bearing_rad)));
  }
  return scan;
}

Grid<float> distance(std::int64_t size) {
  const int side = static_cast<int>(size);
  return distance_field_px(testing::thin_strokes(side, side, side / 10, 1));
}

void count_points(benchmark::State& state) {
  state.counters["points"] =
      benchmark::Counter(static_cast<double>(state.range(0) * state.range(1) * state.iterations()),
                         benchmark::Counter::kIsRate);
  state.counters["s_per_point"] =
      benchmark::Counter(static_cast<double>(state.range(0) * state.range(1) * state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// Arguments: particles, beams, side of the drawing, spread (1) or tracking (0).
void ByDistance(benchmark::State& state) {
  const Grid<float> distance_px = distance(state.range(2));
  const Scan beams = scan(state.range(1));
  bench::ParticleWindow window(state.range(0), state.range(2), state.range(3) != 0, kScale);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        testing::score_by_distance(distance_px, kParams, 1000.0, window.next(), beams.polar));
  }
  count_points(state);
}
BENCHMARK(ByDistance)->ArgsProduct({{2000}, {180}, {400}, {0, 1}})->Unit(benchmark::kMicrosecond);

void ByLookUp(benchmark::State& state) {
  const Grid<float> field = likelihood_field(distance(state.range(2)), kParams);
  const Scan beams = scan(state.range(1));
  bench::ParticleWindow window(state.range(0), state.range(2), state.range(3) != 0, kScale);
  for (auto _ : state) {
    benchmark::DoNotOptimize(
        testing::score_by_look_up(field, std::log(kParams.floor), window.next(), beams.points()));
  }
  count_points(state);
}
BENCHMARK(ByLookUp)
    ->ArgsProduct({{2000, 10000}, {180}, {400}, {0, 1}})
    ->Unit(benchmark::kMicrosecond);

void Score(benchmark::State& state) {
  const Grid<float> field = likelihood_field(distance(state.range(2)), kParams);
  const EndPointKernel kernel(field, std::log(kParams.floor));
  const Scan beams = scan(state.range(1));
  bench::ParticleWindow window(state.range(0), state.range(2), state.range(3) != 0, kScale);
  std::vector<float> scores(static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    kernel.score(window.next(), beams.points(), scores);
    benchmark::DoNotOptimize(scores.data());
    benchmark::ClobberMemory();
  }
  count_points(state);
}
BENCHMARK(Score)
    ->ArgsProduct({{2000, 10000}, {180}, {400, 1000, 2000}, {0, 1}})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(Score)
    ->ArgsProduct({{500, 1000, 4000, 8000, 16000}, {180}, {400}, {0}})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(Score)
    ->ArgsProduct({{2000}, {30, 60, 90, 360, 720}, {400}, {0}})
    ->Unit(benchmark::kMicrosecond);

/// Cells under the end points of 2 000 x 180 particle-beams, as the kernel reads them.
std::vector<std::int32_t> touched_cells(std::int64_t side, bool spread) {
  const Scan beams = scan(180);
  bench::ParticleWindow window(2000, side, spread, kScale);
  const ParticleSpans particles = window.next();
  std::vector<std::int32_t> cells;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    for (const testing::PolarPoint& beam : beams.polar) {
      const double direction_rad = particles.heading_rad[i] + beam.bearing_rad;
      const double length = beam.range_m * std::exp(static_cast<double>(particles.log_scale[i]));
      const double last = static_cast<double>(side - 1);
      const double x = std::clamp(particles.x_px[i] + length * std::cos(direction_rad), 0.0, last);
      const double y = std::clamp(particles.y_px[i] + length * std::sin(direction_rad), 0.0, last);
      cells.push_back(static_cast<std::int32_t>(y) * static_cast<std::int32_t>(side) +
                      static_cast<std::int32_t>(x));
    }
  }
  return cells;
}

/// Arguments of the limits: 2 000 particles, 180 beams, side of the drawing, spread or tracking.
void LimitOfGather(benchmark::State& state) {
  const std::vector<std::int32_t> index = touched_cells(state.range(2), state.range(3) != 0);
  const std::vector<std::uint32_t> cells(static_cast<std::size_t>(state.range(2) * state.range(2)),
                                         1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(bench::sum_by_gather(cells.data(), index));
  }
  count_points(state);
}
BENCHMARK(LimitOfGather)
    ->ArgsProduct({{2000}, {180}, {400, 1000}, {0, 1}})
    ->Unit(benchmark::kMicrosecond);

void LimitOfLoads(benchmark::State& state) {
  const std::vector<std::int32_t> index = touched_cells(state.range(2), state.range(3) != 0);
  const std::vector<std::uint16_t> cells(static_cast<std::size_t>(state.range(2) * state.range(2)),
                                         1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(bench::sum_by_loads(cells.data(), index));
  }
  count_points(state);
}
BENCHMARK(LimitOfLoads)
    ->ArgsProduct({{2000}, {180}, {400, 1000}, {0, 1}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace sketchloc
