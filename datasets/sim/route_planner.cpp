#include "datasets/sim/detail/route_planner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>

#include "registration/distance_field.hpp"

namespace sketchloc::detail {
namespace {

constexpr double kPlanningCell_m = 0.15;
constexpr double kWallWeight_m = 0.5;  ///< a metre at clearance c costs 1 + (weight / c)^2

constexpr std::array<Cell, 8> kNeighbours = {
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

struct Candidate {
  float cost;
  Cell cell;
  bool operator>(const Candidate& other) const { return cost > other.cost; }
};

}  // namespace

RoutePlanner::RoutePlanner(const MetricMap& map, double robot_radius_m)
    : cell_m_(kPlanningCell_m),
      robot_radius_m_(robot_radius_m),
      map_cell_m_(map.cell_m),
      origin_in_world_(map.origin_in_world),
      distance_cells_(distance_field_px(map.cells)) {
  const double ratio = cell_m_ / map_cell_m_;
  clearance_m_ = Grid<float>(std::max(1, static_cast<int>(map.cells.width() / ratio)),
                             std::max(1, static_cast<int>(map.cells.height() / ratio)));
  for (int row = 0; row < clearance_m_.height(); ++row) {
    for (int column = 0; column < clearance_m_.width(); ++column) {
      const Eigen::Vector2d centre = origin_in_world_ + cell_m_ * centre_of({column, row});
      clearance_m_.at({column, row}) = static_cast<float>(clearance_m(centre));
    }
  }
  reachable_ = largest_free_space();
}

double RoutePlanner::clearance_m(const Eigen::Vector2d& point_in_world) const {
  const Eigen::Vector2d point = (point_in_world - origin_in_world_) / map_cell_m_;
  return map_cell_m_ * static_cast<double>(sample(distance_cells_, point).value_or(0.0F));
}

bool RoutePlanner::fits(const Eigen::Vector2d& point_in_world) const {
  return clearance_m(point_in_world) > robot_radius_m_;
}

bool RoutePlanner::fits(const Cell& cell) const {
  // half a planning cell of reserve, so that the way between two centres is free as well
  return clearance_m_.contains(cell) && clearance_m_.at(cell) > robot_radius_m_ + 0.5 * cell_m_;
}

std::vector<Cell> RoutePlanner::flood(const Cell& start, Grid<std::uint8_t>& seen) const {
  std::vector<Cell> component{start};
  seen.at(start) = 1;
  for (std::size_t next = 0; next < component.size(); ++next) {
    const Cell here = component[next];
    for (const Cell& offset : kNeighbours) {
      const Cell neighbour = {here.column + offset.column, here.row + offset.row};
      if (fits(neighbour) && seen.at(neighbour) == 0) {
        seen.at(neighbour) = 1;
        component.push_back(neighbour);
      }
    }
  }
  return component;
}

Grid<std::uint8_t> RoutePlanner::largest_free_space() const {
  Grid<std::uint8_t> seen(clearance_m_.width(), clearance_m_.height());
  flood_border(seen);
  std::vector<Cell> largest;
  for (int row = 0; row < seen.height(); ++row) {
    for (int column = 0; column < seen.width(); ++column) {
      if (seen.at({column, row}) == 0 && fits(Cell{column, row})) {
        std::vector<Cell> component = flood({column, row}, seen);
        if (component.size() > largest.size()) {
          largest = std::move(component);
        }
      }
    }
  }
  Grid<std::uint8_t> reachable(seen.width(), seen.height());
  for (const Cell& cell : largest) {
    reachable.at(cell) = 1;
  }
  return reachable;
}

void RoutePlanner::flood_border(Grid<std::uint8_t>& seen) const {
  for (int row = 0; row < seen.height(); ++row) {
    for (int column = 0; column < seen.width(); ++column) {
      const bool border =
          row == 0 || column == 0 || row + 1 == seen.height() || column + 1 == seen.width();
      if (border && seen.at({column, row}) == 0 && fits(Cell{column, row})) {
        flood({column, row}, seen);
      }
    }
  }
}

std::vector<Eigen::Vector2d> RoutePlanner::standing_places(const PlaneBox& box_in_world) const {
  std::vector<Eigen::Vector2d> places;
  const Cell low = cell_at((box_in_world.low - origin_in_world_) / cell_m_);
  const Cell high = cell_at((box_in_world.high - origin_in_world_) / cell_m_);
  for (int row = std::max(low.row, 0); row <= std::min(high.row, reachable_.height() - 1); ++row) {
    for (int column = std::max(low.column, 0);
         column <= std::min(high.column, reachable_.width() - 1); ++column) {
      const Eigen::Vector2d place = origin_in_world_ + cell_m_ * centre_of({column, row});
      if (reachable_.at({column, row}) != 0 && box_in_world.contains(place)) {
        places.push_back(place);
      }
    }
  }
  return places;
}

std::optional<Polyline> RoutePlanner::route(const Eigen::Vector2d& start_in_world,
                                            const Eigen::Vector2d& goal_in_world) const {
  const Cell start = cell_at((start_in_world - origin_in_world_) / cell_m_);
  const Cell goal = cell_at((goal_in_world - origin_in_world_) / cell_m_);
  if (!fits(start) || !fits(goal)) {
    return std::nullopt;
  }
  const std::optional<Grid<Cell>> onward = ways_to(goal, start);
  if (!onward) {
    return std::nullopt;
  }
  Polyline points{start_in_world};
  for (Cell cell = start; !(cell == goal);) {
    cell = onward->at(cell);
    points.push_back(origin_in_world_ + cell_m_ * centre_of(cell));
  }
  points.back() = goal_in_world;
  return points;
}

/// Dijkstra from the goal, so that following the successors leads from the start onwards.
std::optional<Grid<Cell>> RoutePlanner::ways_to(const Cell& goal, const Cell& start) const {
  Grid<float> cost(clearance_m_.width(), clearance_m_.height(),
                   std::numeric_limits<float>::infinity());
  Grid<Cell> onward(cost.width(), cost.height(), goal);
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> open;
  cost.at(goal) = 0.0F;
  open.push({0.0F, goal});
  while (!open.empty() && !(open.top().cell == start)) {
    const Candidate best = open.top();
    open.pop();
    if (best.cost > cost.at(best.cell)) {
      continue;
    }
    for (const Cell& offset : kNeighbours) {
      const Cell next = {best.cell.column + offset.column, best.cell.row + offset.row};
      const float next_cost = fits(next) ? best.cost + step_cost(next, offset) : best.cost;
      if (fits(next) && next_cost < cost.at(next)) {
        cost.at(next) = next_cost;
        onward.at(next) = best.cell;
        open.push({next_cost, next});
      }
    }
  }
  if (open.empty() && !(start == goal)) {
    return std::nullopt;
  }
  return onward;
}

float RoutePlanner::step_cost(const Cell& to, const Cell& offset) const {
  const double near_wall = kWallWeight_m / static_cast<double>(clearance_m_.at(to));
  const double length_m = cell_m_ * std::hypot(offset.column, offset.row);
  return static_cast<float>(length_m * (1.0 + near_wall * near_wall));
}

}  // namespace sketchloc::detail
