#include "datasets/sim/detail/polyline.hpp"

#include <algorithm>
#include <cmath>

#include "motion/check.hpp"

namespace sketchloc::detail {

double length(std::span<const Eigen::Vector2d> line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    sum += (line[i] - line[i - 1]).norm();
  }
  return sum;
}

Polyline resample(std::span<const Eigen::Vector2d> line, double spacing) {
  check(!line.empty() && spacing > 0.0, "a line has a point, a spacing is positive");
  Polyline fine{line.front()};
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Eigen::Vector2d piece = line[i] - line[i - 1];
    const int steps = std::max(1, static_cast<int>(std::ceil(piece.norm() / spacing)));
    for (int step = 1; step <= steps; ++step) {
      fine.push_back(line[i - 1] + piece * (static_cast<double>(step) / steps));
    }
  }
  return fine;
}

Polyline simplify(std::span<const Eigen::Vector2d> line, double tolerance) {
  if (line.size() < 3) {
    return {line.begin(), line.end()};
  }
  std::size_t farthest = 0;
  double largest = -1.0;
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const double distance = distance_to_segment(line[i], line.front(), line.back());
    if (distance > largest) {
      largest = distance;
      farthest = i;
    }
  }
  if (largest <= tolerance) {
    return {line.front(), line.back()};
  }
  Polyline first = simplify(line.first(farthest + 1), tolerance);
  const Polyline second = simplify(line.subspan(farthest), tolerance);
  first.insert(first.end(), second.begin() + 1, second.end());
  return first;
}

double distance_to_segment(const Eigen::Vector2d& point, const Eigen::Vector2d& from,
                           const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from;
  const double squared_length = along.squaredNorm();
  const double share =
      squared_length > 0.0 ? std::clamp((point - from).dot(along) / squared_length, 0.0, 1.0) : 0.0;
  return (point - from - share * along).norm();
}

}  // namespace sketchloc::detail
