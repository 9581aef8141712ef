#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

#include "registration/range_table.hpp"
#include "tests/support/grid_traversal.hpp"
#include "tests/support/grids.hpp"

namespace sketchloc {
namespace {

void Build(benchmark::State& state) {
  const int size = static_cast<int>(state.range(0));
  const Grid<std::uint8_t> occupied = testing::thin_strokes(size, size, size / 10, 1);
  double megabytes = 0.0;
  for (auto _ : state) {
    const RangeTable table(occupied);
    megabytes = static_cast<double>(table.codes().size()) / 1e6;
    benchmark::DoNotOptimize(table.codes().data());
  }
  state.counters["MB"] = megabytes;
}
BENCHMARK(Build)->Arg(400)->Arg(1000)->Arg(2000)->Unit(benchmark::kMillisecond);

/// |log(range of the table / exact range)| of random rays, in ascending order. Exact: cell by cell
/// from where the ray really starts in its real direction; what is out of reach counts as the
/// farthest range there is.
std::vector<double> log_range_errors(const Grid<std::uint8_t>& occupied, const RangeTable& table,
                                     std::size_t rays) {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> x(0.0, occupied.width());
  std::uniform_real_distribution<double> y(0.0, occupied.height());
  std::uniform_real_distribution<double> heading(-std::numbers::pi, std::numbers::pi);
  const double farthest_px = table.max_range_px();
  std::vector<double> errors;
  while (errors.size() < rays) {
    const Eigen::Vector2d origin(x(engine), y(engine));
    const double heading_rad = heading(engine);
    const double exact_px =
        testing::traverse_beyond_own_stroke(occupied, origin, heading_rad, farthest_px);
    const double range_px = table.range_px(origin, heading_rad).value_or(farthest_px);
    const double least_px = table.params().min_range_px;
    errors.push_back(
        std::abs(std::log(std::max(least_px, range_px) / std::max(least_px, exact_px))));
  }
  std::ranges::sort(errors);
  return errors;
}

/// Not a time: how far the table is off at random poses. Argument: thin strokes (0) or rooms (1).
void ErrorAgainstTraversal(benchmark::State& state) {
  constexpr std::size_t kRays = 200'000;
  const Grid<std::uint8_t> occupied = state.range(0) == 0
                                          ? testing::thin_strokes(1000, 1000, 100, 1)
                                          : testing::rooms(1000, 1000, 100, 20);
  const RangeTable table(occupied);
  std::vector<double> errors;
  for (auto _ : state) {
    errors = log_range_errors(occupied, table, kRays);
  }
  double squares = 0.0;
  for (const double error : errors) {
    squares += error * error;
  }
  state.counters["rms"] = std::sqrt(squares / kRays);
  state.counters["median"] = errors[kRays / 2];
  state.counters["p95"] = errors[kRays / 20 * 19];
  state.counters["max"] = errors.back();
  const auto beyond = errors.end() - std::ranges::lower_bound(errors, 0.3);
  state.counters["beyond_0.3"] = static_cast<double>(beyond) / kRays;
}
BENCHMARK(ErrorAgainstTraversal)->Arg(0)->Arg(1)->Iterations(1)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sketchloc
