#include "planning/path_improver.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "motion/check.hpp"

namespace sketchloc {
namespace {

constexpr double kLongestSide_px = 24.0;  ///< longer ones bend, where bending may pay
constexpr double kMostMove_px = 12.0;
constexpr double kLeastMove_px = 0.3;
constexpr double kGain = 1e-6;  ///< share of the cost that a change has to bring

}  // namespace

PathImprover::PathImprover(const FreeSpace& space, PathPoints path_in_sketch, Rng rng)
    : space_(space), path_(std::move(path_in_sketch)), rng_(rng), move_px_(kMostMove_px) {
  check(path_.size() >= 2, "a way has two ends");
  split_long_sides();
}

double PathImprover::cost_m() const {
  return std::accumulate(side_cost_m_.begin(), side_cost_m_.end(), 0.0);
}

void PathImprover::split_long_sides() {
  PathPoints split = {path_.front()};
  for (std::size_t i = 1; i < path_.size(); ++i) {
    const Eigen::Vector2d from = path_[i - 1];
    const Eigen::Vector2d side = path_[i] - from;
    const int parts = std::max(1, static_cast<int>(std::ceil(side.norm() / kLongestSide_px)));
    for (int part = 1; part < parts; ++part) {
      split.push_back(from + side * (static_cast<double>(part) / parts));
    }
    split.push_back(path_[i]);
  }
  path_ = std::move(split);
  side_cost_m_.clear();
  for (std::size_t i = 1; i < path_.size(); ++i) {
    side_cost_m_.push_back(space_.cost_m(path_[i - 1], path_[i]));
  }
}

bool PathImprover::improve() { return uniform(rng_) < 0.3 ? cut_short() : move_corner(); }

/// A straight line between places on two sides.
bool PathImprover::cut_short() {
  if (path_.size() < 3) {
    return false;
  }
  const auto sides = static_cast<double>(side_cost_m_.size());
  double begin = uniform(0.0, sides, rng_);
  double end = uniform(0.0, sides, rng_);
  if (begin > end) {
    std::swap(begin, end);
  }
  const auto first = static_cast<std::size_t>(begin);
  const auto last = static_cast<std::size_t>(end);
  if (first == last) {
    return false;
  }
  const Eigen::Vector2d from =
      path_[first] + (begin - static_cast<double>(first)) * (path_[first + 1] - path_[first]);
  const Eigen::Vector2d to =
      path_[last] + (end - static_cast<double>(last)) * (path_[last + 1] - path_[last]);
  double before_m = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    before_m += side_cost_m(i);
  }
  const double outer_m = space_.cost_m(path_[first], from) + space_.cost_m(to, path_[last + 1]);
  if (!space_.is_free(from, to) || outer_m + space_.cost_m(from, to) > before_m * (1.0 - kGain)) {
    return false;
  }
  replace(first + 1, last + 1, {from, to});
  return true;
}

/// One corner elsewhere; the tries grow smaller as they fail.
bool PathImprover::move_corner() {
  if (path_.size() < 3) {
    return false;
  }
  const auto corner =
      1 + static_cast<std::size_t>(uniform(0.0, static_cast<double>(path_.size() - 2), rng_));
  const double x = gaussian(move_px_, rng_);
  const Eigen::Vector2d moved = path_[corner] + Eigen::Vector2d(x, gaussian(move_px_, rng_));
  const Eigen::Vector2d& before = path_[corner - 1];
  const Eigen::Vector2d& after = path_[corner + 1];
  const double old_m = side_cost_m(corner - 1) + side_cost_m(corner);
  const bool better =
      space_.is_free(before, moved) && space_.is_free(moved, after) &&
      space_.cost_m(before, moved) + space_.cost_m(moved, after) < old_m * (1.0 - kGain);
  move_px_ = std::clamp(move_px_ * (better ? 1.5 : 0.97), kLeastMove_px, kMostMove_px);
  if (better) {
    replace(corner, corner + 1, {moved});
  }
  return better;
}

/// Other corners in the place of those from first up to before last.
void PathImprover::replace(std::size_t first, std::size_t last, const PathPoints& points) {
  const auto at = [](std::size_t i) { return static_cast<std::ptrdiff_t>(i); };
  path_.erase(path_.begin() + at(first), path_.begin() + at(last));
  path_.insert(path_.begin() + at(first), points.begin(), points.end());
  side_cost_m_.erase(side_cost_m_.begin() + at(first) - 1, side_cost_m_.begin() + at(last));
  std::vector<double> costs_m;
  for (std::size_t i = first; i <= first + points.size(); ++i) {
    costs_m.push_back(space_.cost_m(path_[i - 1], path_[i]));
  }
  side_cost_m_.insert(side_cost_m_.begin() + at(first) - 1, costs_m.begin(), costs_m.end());
}

}  // namespace sketchloc
