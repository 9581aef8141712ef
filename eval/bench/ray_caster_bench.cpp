#include <benchmark/benchmark.h>

#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "registration/ray_caster.hpp"
#include "tests/support/grid_traversal.hpp"
#include "tests/support/grids.hpp"

namespace sketchloc {
namespace {

/// Free places in a building and the beams of one scan: what the simulator asks for.
struct Scene {
  Grid<std::uint8_t> occupied;
  std::vector<Eigen::Vector2d> origins;
  std::vector<float> headings;
};

Scene make_scene(int size, std::size_t beams) {
  Scene scene{.occupied = testing::rooms(size, size, 100, 20), .origins = {}, .headings = {}};
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> place(0.0, size);
  while (scene.origins.size() < 256) {
    const Eigen::Vector2d origin(place(engine), place(engine));
    if (scene.occupied.at(cell_at(origin)) == 0) {
      scene.origins.push_back(origin);
    }
  }
  for (std::size_t i = 0; i < beams; ++i) {
    scene.headings.push_back(2.0F * std::numbers::pi_v<float> * static_cast<float>(i) /
                             static_cast<float>(beams));
  }
  return scene;
}

void count_rays(benchmark::State& state, std::size_t rays_per_iteration) {
  state.counters["rays"] = benchmark::Counter(
      static_cast<double>(rays_per_iteration) * static_cast<double>(state.iterations()),
      benchmark::Counter::kIsRate);
}

void CellByCell(benchmark::State& state) {
  const Scene scene = make_scene(static_cast<int>(state.range(0)), 360);
  std::size_t next = 0;
  for (auto _ : state) {
    const Eigen::Vector2d& origin = scene.origins[next++ % scene.origins.size()];
    for (const float heading_rad : scene.headings) {
      benchmark::DoNotOptimize(testing::traverse(scene.occupied, origin, heading_rad, 10000.0));
    }
  }
  count_rays(state, scene.headings.size());
}
BENCHMARK(CellByCell)->Arg(400)->Arg(1000)->Arg(2000);

void CastScan(benchmark::State& state) {
  const Scene scene =
      make_scene(static_cast<int>(state.range(0)), static_cast<std::size_t>(state.range(1)));
  const RayCaster caster(scene.occupied);
  std::vector<float> ranges(scene.headings.size());
  std::size_t next = 0;
  for (auto _ : state) {
    caster.cast(scene.origins[next++ % scene.origins.size()], scene.headings, 10000.0F, ranges);
    benchmark::DoNotOptimize(ranges.data());
    benchmark::ClobberMemory();
  }
  count_rays(state, scene.headings.size());
}
BENCHMARK(CastScan)->ArgsProduct({{400}, {60, 180, 360, 1080}});
BENCHMARK(CastScan)->ArgsProduct({{1000, 2000}, {360}});

void CastOneRay(benchmark::State& state) {
  const Scene scene = make_scene(400, 360);
  const RayCaster caster(scene.occupied);
  std::size_t next = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(caster.range(scene.origins[next % scene.origins.size()],
                                          scene.headings[(next * 7) % scene.headings.size()],
                                          10000.0F));
    ++next;
  }
  count_rays(state, 1);
}
BENCHMARK(CastOneRay);

void Prepare(benchmark::State& state) {
  const Scene scene = make_scene(static_cast<int>(state.range(0)), 360);
  for (auto _ : state) {
    benchmark::DoNotOptimize(RayCaster(scene.occupied));
  }
}
BENCHMARK(Prepare)->Arg(400)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sketchloc
