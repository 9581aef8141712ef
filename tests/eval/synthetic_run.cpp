#include "tests/eval/synthetic_run.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sketchloc::testing {
namespace {

constexpr int kWidth_px = 900;
constexpr int kHeight_px = 560;
constexpr double kStep_px = 9.0;
constexpr double kSecondsPerStep = 1.05;

void draw_wall(Grid<std::uint8_t>& occupied, const Eigen::Vector2d& from,
               const Eigen::Vector2d& to) {
  const int count = static_cast<int>((to - from).norm()) * 2;
  for (int i = 0; i <= count; ++i) {
    const double share = i / static_cast<double>(count);
    const double wobble = 2.0 * std::sin(9.0 * share + from.x());
    const Eigen::Vector2d point = from + share * (to - from) + Eigen::Vector2d(wobble, wobble);
    for (const double offset : {0.0, 1.0}) {
      const Cell cell = cell_at(point + Eigen::Vector2d(offset, 0.0));
      if (occupied.contains(cell)) {
        occupied.at(cell) = 1;
      }
    }
  }
}

Sketch make_sketch() {
  Sketch sketch;
  sketch.occupied = Grid<std::uint8_t>(kWidth_px, kHeight_px);
  const auto wall = [&](double x1, double y1, double x2, double y2) {
    draw_wall(sketch.occupied, {x1, y1}, {x2, y2});
  };
  wall(50, 50, 850, 50), wall(850, 50, 850, 510), wall(850, 510, 50, 510), wall(50, 510, 50, 50);
  for (const double y : {230.0, 320.0}) {  // the corridor, with a door to each room
    wall(50, y, 150, y), wall(200, y, 420, y), wall(470, y, 690, y), wall(740, y, 850, y);
  }
  for (const double x : {310.0, 590.0}) {
    wall(x, 50, x, 230), wall(x, 320, x, 510);
  }
  wall(90, 90, 130, 90), wall(130, 90, 130, 150), wall(640, 440, 700, 440);
  return sketch;
}

std::vector<Eigen::Vector2d> path_in_sketch() {
  const std::vector<Eigen::Vector2d> corners = {
      {90, 275},  {175, 275}, {175, 140}, {240, 100}, {240, 170}, {175, 200},
      {175, 275}, {445, 275}, {445, 420}, {380, 460}, {520, 450}, {445, 400},
      {445, 275}, {445, 130}, {530, 90},  {445, 160}, {445, 275}, {715, 275},
      {715, 400}, {640, 380}, {780, 460}, {715, 380}, {715, 275}, {715, 120},
      {650, 100}, {800, 140}, {715, 200}, {715, 275}, {300, 275}};
  std::vector<Eigen::Vector2d> path;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Eigen::Vector2d leg = corners[i] - corners[i - 1];
    const int count = static_cast<int>(leg.norm() / kStep_px);
    for (int k = 0; k < count; ++k) {
      path.emplace_back(corners[i - 1] + leg * k / count);
    }
  }
  return path;
}

double px_per_m_at(const Eigen::Vector2d& point) {
  return 18.0 + 5.0 * std::sin(point.x() / 150.0);
}

std::vector<Sim2> robot_poses() {
  const std::vector<Eigen::Vector2d> path = path_in_sketch();
  std::vector<Sim2> poses;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Eigen::Vector2d ahead = path[std::min(i + 3, path.size() - 1)] - path[i];
    const double yaw_rad = ahead.norm() > 0.0 ? std::atan2(ahead.y(), ahead.x()) : 0.0;
    poses.push_back(
        Sim2::from_xy_yaw_scale(path[i].x(), path[i].y(), yaw_rad, px_per_m_at(path[i])));
  }
  return poses;
}

Scan cast_scan(const Sketch& sketch, const Sim2& sketch_from_robot) {
  constexpr int kBeams = 121;
  Scan scan;
  scan.first_angle_rad = -0.5 * std::numbers::pi;
  scan.angle_step_rad = std::numbers::pi / (kBeams - 1);
  scan.max_range_m = 20.0;
  for (std::size_t beam = 0; beam < kBeams; ++beam) {
    const double angle_rad = scan.angle_rad(beam);
    const Eigen::Vector2d direction(std::cos(angle_rad), std::sin(angle_rad));
    double range_m = 0.1;
    while (range_m < scan.max_range_m) {
      const Cell cell = cell_at(sketch_from_robot * (range_m * direction));
      if (!sketch.occupied.contains(cell) || sketch.occupied.at(cell) != 0) {
        break;
      }
      range_m += 0.1;
    }
    scan.ranges_m.push_back(static_cast<float>(range_m));
  }
  return scan;
}

/// How far the estimate is off, in metres along and across the drawing.
Eigen::Vector2d painted_error_m(std::size_t step, std::size_t count, Outcome outcome) {
  const double share = static_cast<double>(step) / static_cast<double>(count);
  Eigen::Vector2d error(0.5 * std::sin(40.0 * share) + 0.3 * std::sin(17.0 * share),
                        0.5 * std::cos(31.0 * share) * share);
  const bool elsewhere = share > 0.55 && (outcome == Outcome::Lost || share < 0.72);
  if (outcome != Outcome::Located && elsewhere) {
    error += Eigen::Vector2d(-9.0, 2.5) * std::min(1.0, 12.0 * (share - 0.55));
  }
  return error;
}

StepReport make_report(std::size_t step, std::size_t count, const Sim2& reference,
                       Outcome outcome) {
  const Eigen::Vector2d error_m = painted_error_m(step, count, outcome);
  const Eigen::Vector2d position = reference.translation() + reference.scale() * error_m;
  const double sigma_px = reference.scale() * (0.4 + 0.35 * error_m.norm());
  const double wave = std::sin(0.3 * static_cast<double>(step));
  StepReport report;
  report.step = step;
  report.time_s = 100.0 + kSecondsPerStep * static_cast<double>(step);
  report.estimate.sketch_from_robot = Sim2::from_xy_yaw_scale(
      position.x(), position.y(), reference.yaw_rad() + 0.06 * error_m.norm() + 0.05 * wave,
      reference.scale() * (1.0 + 0.08 * wave));
  report.estimate.covariance =
      Eigen::Vector4d(sigma_px * sigma_px, 0.5 * sigma_px * sigma_px, 0.02, 0.01).asDiagonal();
  report.updated = step % 4 != 0;
  report.log_likelihood = -1.0 - 0.4 * error_m.norm() + 0.2 * wave;
  report.particles = static_cast<std::size_t>(2000.0 + 300.0 * error_m.norm());
  report.effective_particles = static_cast<double>(report.particles) * (0.6 + 0.3 * wave);
  report.injected_share = error_m.norm() > 6.0 ? 0.03 : 0.0;
  report.localized_probability = error_m.norm() > 6.0 ? 0.125 : 0.875;
  report.challengers = error_m.norm() > 6.0 ? 3 : 0;
  report.found_anew = error_m.norm() > 12.0;
  return report;
}

ParticleSnapshot make_snapshot(const StepReport& report, std::uint64_t seed) {
  constexpr int kShown = 300;
  Rng rng = make_rng(seed, report.step);
  ParticleSnapshot snapshot{.step = report.step, .particles = {}};
  const Sim2& mean = report.estimate.sketch_from_robot;
  for (int i = 0; i < kShown; ++i) {
    const double x = mean.x() + gaussian(std::sqrt(report.estimate.covariance(0, 0)), rng);
    const double y = mean.y() + gaussian(std::sqrt(report.estimate.covariance(1, 1)), rng);
    snapshot.particles.push_back({.x_px = static_cast<float>(x),
                                  .y_px = static_cast<float>(y),
                                  .yaw_rad = static_cast<float>(mean.yaw_rad()),
                                  .weight = 1.0F / kShown});
  }
  return snapshot;
}

void add_step(RunRecord& record, std::size_t step, std::size_t count, const Sim2& reference,
              Outcome outcome) {
  constexpr std::size_t kSnapshotEvery = 15;
  record.steps.push_back(make_report(step, count, reference, outcome));
  record.run.steps.push_back({.scan = cast_scan(record.sketch, reference), .odom_from_robot = {}});
  record.reference->poses.push_back({.step = step,
                                     .time_s = record.steps.back().time_s,
                                     .sketch_from_robot = reference,
                                     .uncertainty_m = 0.5});
  if (step % kSnapshotEvery == 0) {
    record.snapshots.push_back(make_snapshot(record.steps.back(), record.seed));
  }
}

}  // namespace

RunRecord make_synthetic_run(Outcome outcome) {
  RunRecord record;
  record.title = "Six made-up rooms <made up> & painted errors";
  record.seed = 7;
  record.commit = "0123abc";
  record.inputs = {{"drawing", "six rooms & \"more\".png"}, {"log", "drive<1>.jsonl"}};
  record.parameters = "filter:\n  particles: 2000  # & more\n  sigma: <0.3>\n";
  record.sketch = make_sketch();
  record.reference = Reference();
  record.cost = RunCost{.seconds = 12.3, .peak_memory_mb = 86.0};
  const std::vector<Sim2> poses = robot_poses();
  for (std::size_t step = 0; step < poses.size(); ++step) {
    add_step(record, step, poses.size(), poses[step], outcome);
  }
  return record;
}

}  // namespace sketchloc::testing
