#include <benchmark/benchmark.h>

#include "registration/range_table.hpp"
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

}  // namespace
}  // namespace sketchloc
