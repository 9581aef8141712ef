#pragma once

#include <numbers>
#include <vector>

#include "datasets/scan.hpp"
#include "datasets/sim/building.hpp"
#include "motion/random.hpp"
#include "motion/se2.hpp"
#include "registration/ray_caster.hpp"

namespace sketchloc {

/// A planar LIDAR. Defaults: the 180 degree scanner of the classic indoor logs.
struct LidarModel {
  double field_of_view_rad = std::numbers::pi;  ///< in (0, 2 pi]
  int beams = 181;                              ///< >= 2; evenly spaced, the first on the right
  double min_range_m = 0.05;                    ///< >= 0
  double max_range_m = 30.0;                    ///< above min_range_m
  double range_sigma_m = 0.015;                 ///< noise of one range, >= 0
  double dropout_share = 0.005;                 ///< beams that do not return, in [0, 1]
  double short_share = 0.002;                   ///< beams stopped early (people, dust), in [0, 1]
  double glass_pass_share = 0.85;               ///< beams that go through glass, in [0, 1]
  double forward_m = 0.0;                       ///< of the laser in the robot frame
};

template <typename Visitor>
void visit_fields(LidarModel& lidar, Visitor&& visit) {
  visit("field_of_view_rad", lidar.field_of_view_rad);
  visit("beams", lidar.beams);
  visit("min_range_m", lidar.min_range_m);
  visit("max_range_m", lidar.max_range_m);
  visit("range_sigma_m", lidar.range_sigma_m);
  visit("dropout_share", lidar.dropout_share);
  visit("short_share", lidar.short_share);
  visit("glass_pass_share", lidar.glass_pass_share);
  visit("forward_m", lidar.forward_m);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const LidarModel& lidar);

/// Casts scans in one building.
class LidarSimulator {
 public:
  LidarSimulator(const MetricMap& map, const LidarModel& model);

  /// What the robot sees from a pose; beams without a return read max_range_m.
  Scan scan(const Se2& world_from_robot, double time_s, Rng& rng) const;

 private:
  double noisy_range_m(double to_anything_m, double to_solid_m, Rng& rng) const;

  LidarModel model_;
  double cell_m_;
  Eigen::Vector2d origin_in_world_;
  RayCaster anything_;  ///< stops at glass and at solid cells
  RayCaster solid_;     ///< stops at solid cells only
};

}  // namespace sketchloc
