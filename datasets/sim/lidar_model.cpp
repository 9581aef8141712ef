#include "datasets/sim/lidar_model.hpp"

#include <algorithm>
#include <cmath>

#include "motion/validate.hpp"

namespace sketchloc {
namespace {

Grid<std::uint8_t> solid_cells(const MetricMap& map) {
  Grid<std::uint8_t> solid = map.cells;
  for (int row = 0; row < solid.height(); ++row) {
    for (std::uint8_t& cell : solid.row(row)) {
      cell = cell == MetricMap::Solid ? 1 : 0;
    }
  }
  return solid;
}

/// A full turn must not see its first direction twice.
double angle_step_rad(const LidarModel& model) {
  const bool full_turn = model.field_of_view_rad >= 2.0 * std::numbers::pi - 1e-9;
  return model.field_of_view_rad / (full_turn ? model.beams : model.beams - 1);
}

}  // namespace

void validate(const LidarModel& lidar) {
  require_in_range("field_of_view_rad", lidar.field_of_view_rad, 1e-3,
                   2.0 * std::numbers::pi + 1e-9);
  require_at_least("beams", lidar.beams, 2.0);
  require_at_least("min_range_m", lidar.min_range_m, 0.0);
  require_above("max_range_m", lidar.max_range_m, lidar.min_range_m);
  require_at_least("range_sigma_m", lidar.range_sigma_m, 0.0);
  require_in_range("dropout_share", lidar.dropout_share, 0.0, 1.0);
  require_in_range("short_share", lidar.short_share, 0.0, 1.0);
  require_in_range("glass_pass_share", lidar.glass_pass_share, 0.0, 1.0);
  require_in_range("forward_m", lidar.forward_m, -5.0, 5.0);
}

LidarSimulator::LidarSimulator(const MetricMap& map, const LidarModel& model)
    : model_(model),
      cell_m_(map.cell_m),
      origin_in_world_(map.origin_in_world),
      anything_(map.cells),
      solid_(solid_cells(map)) {
  validate(model);
}

Scan LidarSimulator::scan(const Se2& world_from_robot, double time_s, Rng& rng) const {
  const std::size_t beams = static_cast<std::size_t>(model_.beams);
  Scan scan{.time_s = time_s,
            .first_angle_rad = -0.5 * model_.field_of_view_rad,
            .angle_step_rad = angle_step_rad(model_),
            .min_range_m = model_.min_range_m,
            .max_range_m = model_.max_range_m,
            .robot_from_laser = Se2::from_xy_yaw(model_.forward_m, 0.0, 0.0),
            .ranges_m = std::vector<float>(beams)};
  const Se2 world_from_laser = world_from_robot * scan.robot_from_laser;
  const Eigen::Vector2d origin = (world_from_laser.translation() - origin_in_world_) / cell_m_;
  std::vector<float> headings_rad(beams);
  for (std::size_t beam = 0; beam < beams; ++beam) {
    headings_rad[beam] = static_cast<float>(world_from_laser.yaw_rad() + scan.angle_rad(beam));
  }
  const float reach_cells = static_cast<float>(model_.max_range_m / cell_m_);
  std::vector<float> to_anything(beams);
  std::vector<float> to_solid(beams);
  anything_.cast(origin, headings_rad, reach_cells, to_anything);
  solid_.cast(origin, headings_rad, reach_cells, to_solid);
  for (std::size_t beam = 0; beam < beams; ++beam) {
    const double range_m =
        noisy_range_m(cell_m_ * to_anything[beam], cell_m_ * to_solid[beam], rng);
    scan.ranges_m[beam] = static_cast<float>(range_m);
  }
  return scan;
}

double LidarSimulator::noisy_range_m(double to_anything_m, double to_solid_m, Rng& rng) const {
  const bool through_glass = uniform(rng) < model_.glass_pass_share;
  const double clear_m = through_glass ? to_solid_m : to_anything_m;
  const bool dropped = uniform(rng) < model_.dropout_share;
  const bool stopped = uniform(rng) < model_.short_share;
  const double share_of_way = uniform(rng);
  const double noise_m = gaussian(model_.range_sigma_m, rng);
  const double seen_m = stopped ? share_of_way * clear_m : clear_m;
  if (dropped || seen_m >= model_.max_range_m) {
    return model_.max_range_m;
  }
  return std::clamp(seen_m + noise_m, model_.min_range_m, model_.max_range_m);
}

}  // namespace sketchloc
