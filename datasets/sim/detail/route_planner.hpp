#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "datasets/sim/building.hpp"
#include "datasets/sim/detail/polyline.hpp"

namespace sketchloc::detail {

/// Ways through the free space of a building, on a coarse grid of clearances.
class RoutePlanner {
 public:
  RoutePlanner(const MetricMap& map, double robot_radius_m);

  /// Distance to the middle of the nearest cell of a wall or thing; 0 outside the map.
  double clearance_m(const Eigen::Vector2d& point_in_world) const;
  bool fits(const Eigen::Vector2d& point_in_world) const;

  /// Where the robot fits inside a box and can be driven to from the largest free space.
  std::vector<Eigen::Vector2d> standing_places(const PlaneBox& box_in_world) const;

  /// Points about one cell apart, from start to goal; none where there is no way.
  std::optional<Polyline> route(const Eigen::Vector2d& start_in_world,
                                const Eigen::Vector2d& goal_in_world) const;

 private:
  bool fits(const Cell& cell) const;
  std::vector<Cell> flood(const Cell& start, Grid<std::uint8_t>& seen) const;
  void flood_border(Grid<std::uint8_t>& seen) const;
  Grid<std::uint8_t> largest_free_space() const;  ///< without what is open to the map's border
  std::optional<Grid<Cell>> ways_to(const Cell& goal, const Cell& start) const;
  float step_cost(const Cell& to, const Cell& offset) const;

  double cell_m_;  ///< of the planning grid
  double robot_radius_m_;
  double map_cell_m_;
  Eigen::Vector2d origin_in_world_;
  Grid<float> distance_cells_;    ///< per cell of the map
  Grid<float> clearance_m_;       ///< per planning cell
  Grid<std::uint8_t> reachable_;  ///< 1 in the largest connected free space
};

}  // namespace sketchloc::detail
