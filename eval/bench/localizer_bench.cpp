#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "filter/localizer.hpp"
#include "registration/ray_caster.hpp"
#include "tests/support/grids.hpp"

namespace sketchloc {
namespace {

constexpr double kPxPerM = 20.0;
constexpr int kStepsPerRound = 48;  // 0.13 m each: every one passes the motion gate

/// Round and round in a room in the middle of a building, without end.
struct Drive {
  std::vector<Sim2> sketch_from_robot;
  std::vector<Se2> odom_from_robot;
  std::vector<Scan> scans;
};

Scan scan_at(const Sim2& sketch_from_robot, const RayCaster& caster, Rng& rng) {
  constexpr int kReadings = 720;
  Scan scan;
  scan.first_angle_rad = -std::numbers::pi;
  scan.angle_step_rad = 2.0 * std::numbers::pi / kReadings;
  scan.max_range_m = 80.0;
  for (std::size_t beam = 0; beam < kReadings; ++beam) {
    const auto heading_rad = static_cast<float>(sketch_from_robot.yaw_rad() + scan.angle_rad(beam));
    const double range_px = caster.range(sketch_from_robot.translation(), heading_rad, 1e4F);
    scan.ranges_m.push_back(static_cast<float>(range_px / kPxPerM + gaussian(0.01, rng)));
  }
  return scan;
}

Drive drive_round(const Sketch& sketch) {
  const RayCaster caster(sketch.occupied);
  const double middle_px = 50.0 + 100.0 * (sketch.width_px() / 200);
  Rng rng = make_rng(3);
  Drive drive;
  for (int step = 0; step < kStepsPerRound; ++step) {
    const double turn_rad = 2.0 * std::numbers::pi * step / kStepsPerRound;
    const Eigen::Vector2d round_m(std::sin(turn_rad), -std::cos(turn_rad));
    const Eigen::Vector2d place_px = Eigen::Vector2d::Constant(middle_px) + kPxPerM * round_m;
    drive.odom_from_robot.push_back(Se2::from_xy_yaw(round_m.x(), round_m.y(), turn_rad));
    drive.sketch_from_robot.push_back(
        Sim2::from_xy_yaw_scale(place_px.x(), place_px.y(), turn_rad, kPxPerM));
    drive.scans.push_back(scan_at(drive.sketch_from_robot.back(), caster, rng));
  }
  return drive;
}

Sketch building(std::int64_t side_px) {
  const int side = static_cast<int>(side_px);
  Sketch sketch;
  sketch.occupied = testing::rooms(side, side, 100, 20);
  return sketch;
}

/// Steps the localizer through the drive; says whether it still knows where it is, so that nobody
/// takes the time of a lost filter for that of one at work.
void time_steps(benchmark::State& state, const Sketch& sketch, const LocalizerParams& params) {
  const Drive drive = drive_round(sketch);
  Localizer localizer(sketch, params);
  localizer.start_at(drive.sketch_from_robot.front());
  std::size_t next = 0;
  double updates = 0.0;
  double resamplings = 0.0;
  double error_m = 0.0;
  const auto step = [&] {
    const std::size_t i = next++ % kStepsPerRound;
    const StepReport& report = localizer.step(drive.scans[i], drive.odom_from_robot[i]);
    updates += report.updated ? 1.0 : 0.0;
    resamplings += report.resampled ? 1.0 : 0.0;
    error_m +=
        (report.estimate.sketch_from_robot.translation() - drive.sketch_from_robot[i].translation())
            .norm() /
        kPxPerM;
  };
  for (int warm_up = 0; warm_up < kStepsPerRound; ++warm_up) {
    step();
  }
  for (auto _ : state) {
    step();
  }
  const auto steps = static_cast<double>(next);
  state.counters["updated"] = updates / steps;
  state.counters["resampled"] = resamplings / steps;
  state.counters["error_m"] = error_m / steps;
}

KldParams exactly(std::int64_t particles) {
  const auto count = static_cast<std::size_t>(particles);
  return {.min_particles = count, .max_particles = count};
}

/// A whole update: predict, weigh, estimate, resample. Arguments: particles, beams, side of the
/// map.
void EndPointsOnMetricMap(benchmark::State& state) {
  Sketch map = building(state.range(2));
  map.px_per_m = kPxPerM;
  LocalizerParams params = metric_localizer_params();
  params.particles = exactly(state.range(0));
  params.end_points.selection.beams = static_cast<int>(state.range(1));
  time_steps(state, map, params);
}

/// The same with the beam model and particles that carry a strain.
void BeamsInDrawing(benchmark::State& state) {
  LocalizerParams params;
  params.particles = exactly(state.range(0));
  params.beams.selection.beams = static_cast<int>(state.range(1));
  time_steps(state, building(state.range(2)), params);
}

BENCHMARK(EndPointsOnMetricMap)
    ->ArgsProduct({{2000, 10000}, {180}, {1000}})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(BeamsInDrawing)
    ->ArgsProduct({{2000, 10000}, {60}, {1000}})
    ->Unit(benchmark::kMicrosecond);

// Cost against particles, beams and the size of the drawing.
BENCHMARK(EndPointsOnMetricMap)
    ->ArgsProduct({{500, 1000, 4000, 8000, 16000, 32000}, {180}, {1000}})
    ->ArgsProduct({{2000}, {15, 30, 60, 120, 240}, {1000}})
    ->ArgsProduct({{2000}, {180}, {250, 500, 2000}})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK(BeamsInDrawing)
    ->ArgsProduct({{500, 1000, 4000, 8000, 16000, 32000}, {60}, {1000}})
    ->ArgsProduct({{2000}, {15, 30, 120, 240}, {1000}})
    ->ArgsProduct({{2000}, {60}, {250, 500, 2000}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace sketchloc
