#include "planning/path.hpp"

#include <algorithm>
#include <limits>

#include "planning/detail/segment_cells.hpp"

namespace sketchloc {

PathFigures figures_of(std::span<const Eigen::Vector2d> path_in_sketch, const FreeSpace& space) {
  PathFigures figures;
  if (path_in_sketch.empty()) {
    return figures;
  }
  figures.least_clearance_m = space.clearance_m(path_in_sketch.front());
  double way_px = 0.0;
  double clearance_by_way = 0.0;
  bool crosses = false;
  for (std::size_t i = 1; i < path_in_sketch.size(); ++i) {
    const Eigen::Vector2d& from = path_in_sketch[i - 1];
    const Eigen::Vector2d& to = path_in_sketch[i];
    figures.length_m += space.length_m(from, to);
    figures.cost_m += space.cost_m(from, to);
    detail::visit_cells(from, to, [&](const Cell& cell, double part_px) {
      const double clearance_m = space.clearance_m(centre_of(cell));
      figures.least_clearance_m = std::min(figures.least_clearance_m, clearance_m);
      clearance_by_way += part_px * clearance_m;
      way_px += part_px;
      const bool crosses_here = space.is_crossing(centre_of(cell));
      figures.crossings += crosses_here && !crosses ? 1 : 0;
      crosses = crosses_here;
    });
  }
  figures.mean_clearance_m = way_px > 0.0 ? clearance_by_way / way_px : figures.least_clearance_m;
  return figures;
}

bool is_free(std::span<const Eigen::Vector2d> path_in_sketch, const FreeSpace& space) {
  for (std::size_t i = 1; i < path_in_sketch.size(); ++i) {
    if (!space.is_free(path_in_sketch[i - 1], path_in_sketch[i])) {
      return false;
    }
  }
  return !path_in_sketch.empty() && space.is_free(path_in_sketch.front());
}

PathPoints rest_of(std::span<const Eigen::Vector2d> path_in_sketch,
                   const Eigen::Vector2d& point_in_sketch) {
  double least_px = std::numeric_limits<double>::infinity();
  PathPoints rest;
  std::size_t next = 0;
  Eigen::Vector2d entry = point_in_sketch;
  for (std::size_t i = 0; i < path_in_sketch.size(); ++i) {
    const Eigen::Vector2d& from = path_in_sketch[i == 0 ? 0 : i - 1];
    const Eigen::Vector2d side = path_in_sketch[i] - from;
    const double share =
        side.squaredNorm() > 0.0 ? (point_in_sketch - from).dot(side) / side.squaredNorm() : 0.0;
    const Eigen::Vector2d nearest = from + std::clamp(share, 0.0, 1.0) * side;
    const double apart_px = (nearest - point_in_sketch).norm();
    if (apart_px < least_px) {
      least_px = apart_px;
      next = i;
      entry = nearest;
    }
  }
  if (path_in_sketch.empty()) {
    return rest;
  }
  rest = {point_in_sketch, entry};
  rest.insert(rest.end(), path_in_sketch.begin() + static_cast<std::ptrdiff_t>(next),
              path_in_sketch.end());
  return rest;
}

PathPoints corners_of(std::span<const Eigen::Vector2d> path_in_sketch) {
  PathPoints corners;
  for (std::size_t i = 0; i < path_in_sketch.size(); ++i) {
    if (i > 0 && i + 1 < path_in_sketch.size()) {
      const Eigen::Vector2d in = path_in_sketch[i] - path_in_sketch[i - 1];
      const Eigen::Vector2d out = path_in_sketch[i + 1] - path_in_sketch[i];
      if (in.x() * out.y() == in.y() * out.x() && in.dot(out) >= 0.0) {
        continue;
      }
    }
    corners.push_back(path_in_sketch[i]);
  }
  return corners;
}

PathPoints pulled_straight(std::span<const Eigen::Vector2d> path_in_sketch,
                           const FreeSpace& space) {
  if (path_in_sketch.empty()) {
    return {};
  }
  std::vector<double> cost_m(path_in_sketch.size(), 0.0);  // from the start on
  for (std::size_t i = 1; i < path_in_sketch.size(); ++i) {
    cost_m[i] = cost_m[i - 1] + space.cost_m(path_in_sketch[i - 1], path_in_sketch[i]);
  }
  PathPoints pulled = {path_in_sketch.front()};
  for (std::size_t at = 0; at + 1 < path_in_sketch.size();) {
    std::size_t next = at + 1;
    const auto may_skip_to = [&](std::size_t far) {
      return space.is_free(path_in_sketch[at], path_in_sketch[far]) &&
             space.cost_m(path_in_sketch[at], path_in_sketch[far]) <=
                 (cost_m[far] - cost_m[at]) * (1.0 + 1e-9);
    };
    for (std::size_t far = path_in_sketch.size() - 1; far > next; --far) {
      if (may_skip_to(far)) {
        next = far;
      }
    }
    pulled.push_back(path_in_sketch[next]);
    at = next;
  }
  return pulled;
}

}  // namespace sketchloc
