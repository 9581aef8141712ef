#pragma once

#include <cstdint>
#include <optional>

#include "planning/grid_search.hpp"
#include "planning/turning_curve.hpp"

namespace sketchloc {

/// A question of a robot that cannot turn on the spot; a heading that is not given is free.
struct TurningQuery {
  Eigen::Vector2d start_in_sketch = Eigen::Vector2d::Zero();
  Eigen::Vector2d goal_in_sketch = Eigen::Vector2d::Zero();
  std::optional<double> start_heading_rad = std::nullopt;
  std::optional<double> goal_heading_rad = std::nullopt;
  double radius_px = 1.0;  ///< least one, > 0
};

/// A cheap way forwards of arcs and straight lines, none of them tighter than the radius: A* over
/// places and headings, whose nodes keep their exact pose (Hybrid A* [Dolgov10]). The price to go
/// is that of the grid without headings. Where it says that there is none, there may be one that
/// needs finer steps.
struct TurningSearch {
  enum class Status { Found, NoPath, OutOfTime };
  Status status = Status::NoPath;
  TurningCurve curve;  ///< where found
};
TurningSearch search_turning(const FreeSpace& space, const TurningQuery& query,
                             const TimeIsOver& out_of_time = {});

/// How a curve is made shorter.
struct Shortening {
  double radius_px = 1.0;  ///< least one, > 0
  int tries = 300;         ///< >= 0
  std::uint64_t seed = 1;
};

/// The same way with parts of it replaced by the shortest curve, where that is free and costs less.
TurningCurve shortened(TurningCurve curve, const FreeSpace& space, const Shortening& by,
                       const TimeIsOver& out_of_time = {});

}  // namespace sketchloc
