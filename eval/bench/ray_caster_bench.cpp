#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "registration/ray_caster.hpp"
#include "tests/support/grid_traversal.hpp"
#include "tests/support/grids.hpp"

namespace sketchloc {
namespace {

/// A building, places in it where scans are taken and the beams of one scan.
struct Scene {
  Grid<std::uint8_t> occupied;
  std::vector<Eigen::Vector2d> origins;
  std::vector<float> headings;
};

/// Scans from a robot that drives (6 cells from scan to scan, 0.3 m at 5 cm per cell), or each from
/// somewhere else, which finds the caches cold.
Scene make_scene(int size, std::size_t beams, bool drives) {
  Scene scene{.occupied = testing::rooms(size, size, 100, 20), .origins = {}, .headings = {}};
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> place(0.0, size);
  std::normal_distribution<double> turn(0.0, 0.3);
  double heading_rad = 0.0;
  Eigen::Vector2d origin(30.0, 30.0);
  while (scene.origins.size() < 256) {
    heading_rad += turn(engine);
    const Eigen::Vector2d ahead =
        origin + 6.0 * Eigen::Vector2d(std::cos(heading_rad), std::sin(heading_rad));
    const Eigen::Vector2d next = drives ? ahead : Eigen::Vector2d(place(engine), place(engine));
    if (scene.occupied.contains(cell_at(next)) && scene.occupied.at(cell_at(next)) == 0) {
      origin = next;
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

/// Arguments: side of the grid, scans of a drive (1) or from anywhere (0); CastScan: beams.
void CellByCell(benchmark::State& state) {
  const Scene scene = make_scene(static_cast<int>(state.range(0)), 360, state.range(1) != 0);
  std::size_t next = 0;
  for (auto _ : state) {
    const Eigen::Vector2d& origin = scene.origins[next++ % scene.origins.size()];
    for (const float heading_rad : scene.headings) {
      benchmark::DoNotOptimize(testing::traverse(scene.occupied, origin, heading_rad, 10000.0));
    }
  }
  count_rays(state, scene.headings.size());
}
BENCHMARK(CellByCell)->ArgsProduct({{400, 1000, 2000}, {0, 1}});

void CastScan(benchmark::State& state) {
  const Scene scene = make_scene(static_cast<int>(state.range(0)),
                                 static_cast<std::size_t>(state.range(2)), state.range(1) != 0);
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
BENCHMARK(CastScan)->ArgsProduct({{400}, {0, 1}, {60, 180, 360, 1080}});
BENCHMARK(CastScan)->ArgsProduct({{1000, 2000}, {0, 1}, {360}});

void CastOneRay(benchmark::State& state) {
  const Scene scene = make_scene(400, 360, true);
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
  const Scene scene = make_scene(static_cast<int>(state.range(0)), 360, true);
  for (auto _ : state) {
    benchmark::DoNotOptimize(RayCaster(scene.occupied));
  }
}
BENCHMARK(Prepare)->Arg(400)->Arg(1000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace sketchloc
