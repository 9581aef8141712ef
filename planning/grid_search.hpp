#pragma once

#include <functional>
#include <optional>

#include "planning/path.hpp"

namespace sketchloc {

/// Whether the time is over; asked now and then.
using TimeIsOver = std::function<bool()>;

/// What a search makes least.
enum class GridPrice {
  Length,    ///< quickest to search
  Objective  ///< what the space charges
};

/// The cheapest way from px to px, eight neighbours each, corners not cut: A* [Hart68]. Finds one
/// wherever there is one on the grid. The ends are the given points.
struct GridSearch {
  enum class Status { Found, NoPath, OutOfTime };
  Status status = Status::NoPath;
  PathPoints path_in_sketch;  ///< where found
};
GridSearch search_grid(const FreeSpace& space, const Eigen::Vector2d& start_in_sketch,
                       const Eigen::Vector2d& goal_in_sketch,
                       GridPrice price = GridPrice::Objective, const TimeIsOver& out_of_time = {});

}  // namespace sketchloc
