#include <benchmark/benchmark.h>

#include "registration/distance_field.hpp"
#include "tests/support/grids.hpp"

namespace sketchloc {
namespace {

void Rooms(benchmark::State& state) {
  const int size = static_cast<int>(state.range(0));
  const Grid<std::uint8_t> occupied = testing::rooms(size, size, 100, 20);
  for (auto _ : state) {
    benchmark::DoNotOptimize(distance_field_px(occupied));
  }
}
BENCHMARK(Rooms)->Arg(400)->Arg(1000)->Arg(2000)->Unit(benchmark::kMillisecond);

void ThinStrokes(benchmark::State& state) {
  const int size = static_cast<int>(state.range(0));
  const Grid<std::uint8_t> occupied = testing::thin_strokes(size, size, size / 10, 1);
  for (auto _ : state) {
    benchmark::DoNotOptimize(distance_field_px(occupied));
  }
}
BENCHMARK(ThinStrokes)->Arg(400)->Arg(1000)->Arg(2000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sketchloc
