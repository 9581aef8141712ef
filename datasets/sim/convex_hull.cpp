#include "datasets/sim/detail/convex_hull.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace sketchloc::detail {
namespace {

/// Above 0 where a, b, c turn left.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d first = b - a;
  const Eigen::Vector2d second = c - a;
  return first.x() * second.y() - first.y() * second.x();
}

/// The hull below the line from the first to the last of sorted points, the last one left out.
std::vector<Eigen::Vector2d> lower_chain(std::span<const Eigen::Vector2d> sorted) {
  std::vector<Eigen::Vector2d> chain;
  for (const Eigen::Vector2d& point : sorted) {
    while (chain.size() >= 2 && turn(chain[chain.size() - 2], chain.back(), point) <= 0.0) {
      chain.pop_back();
    }
    chain.push_back(point);
  }
  chain.pop_back();
  return chain;
}

}  // namespace

std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points) {
  // Andrew's monotone chain: from left to right below, from right to left above.
  std::ranges::sort(points, {}, [](const Eigen::Vector2d& p) { return std::tuple(p.x(), p.y()); });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) {
    return points;
  }
  std::vector<Eigen::Vector2d> hull = lower_chain(points);
  std::ranges::reverse(points);
  const std::vector<Eigen::Vector2d> upper = lower_chain(points);
  hull.insert(hull.end(), upper.begin(), upper.end());
  return hull;
}

bool is_inside(std::span<const Eigen::Vector2d> hull, const Eigen::Vector2d& point) {
  if (hull.size() < 3) {
    return false;
  }
  for (std::size_t i = 0; i < hull.size(); ++i) {
    if (turn(hull[i], hull[(i + 1) % hull.size()], point) < 0.0) {
      return false;
    }
  }
  return true;
}

}  // namespace sketchloc::detail
