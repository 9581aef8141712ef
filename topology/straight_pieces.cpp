#include "topology/straight_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "motion/angles.hpp"
#include "motion/check.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

/// A chord that is much shorter than the way belongs to a robot that went back and forth.
constexpr double kLeastChord = 0.8;  ///< of the way

/// Is the heading steady around each pose?
std::vector<bool> steady_poses(const Travel& travel, const StraightParams& params) {
  const double most_turn_rad = rad_from_deg(params.most_turn_deg);
  std::vector<bool> steady(travel.way_m.size());
  for (std::size_t i = 0; i < steady.size(); ++i) {
    const double at_m = travel.way_m[i];
    const auto from = std::ranges::lower_bound(travel.way_m, at_m - 0.5 * params.window_m);
    const auto to = std::ranges::upper_bound(travel.way_m, at_m + 0.5 * params.window_m);
    const auto [low, high] =
        std::minmax_element(travel.yaw_rad.begin() + (from - travel.way_m.begin()),
                            travel.yaw_rad.begin() + (to - travel.way_m.begin()));
    steady[i] = *high - *low < most_turn_rad;
  }
  return steady;
}

/// The mean heading by way.
double mean_yaw_rad(const Travel& travel, std::size_t first, std::size_t last) {
  double sum = 0.0;
  for (std::size_t i = first; i < last; ++i) {
    sum +=
        (travel.way_m[i + 1] - travel.way_m[i]) * 0.5 * (travel.yaw_rad[i] + travel.yaw_rad[i + 1]);
  }
  return sum / (travel.way_m[last] - travel.way_m[first]);
}

/// The chord's direction, unwrapped beside the heading; opposite where the robot drives backwards.
double axis_beside(double yaw_rad, double chord_rad) {
  const double halves = std::round((yaw_rad - chord_rad) / std::numbers::pi);
  return chord_rad + std::numbers::pi * halves;
}

}  // namespace

void validate(const StraightParams& params) {
  require_above("window_m", params.window_m, 0.0);
  require_in_range("most_turn_deg", params.most_turn_deg, 1.0, 44.0);
  require_above("shortest_m", params.shortest_m, 0.0);
  require_at_least("longest_m", params.longest_m, params.shortest_m);
}

std::vector<StraightPiece> straight_pieces(std::span<const Se2> odom_from_robot,
                                           const Travel& travel, const StraightParams& params) {
  validate(params);
  check(odom_from_robot.size() == travel.way_m.size(), "the travel of these poses");
  const std::vector<bool> steady = steady_poses(travel, params);
  const double most_turn_rad = rad_from_deg(params.most_turn_deg);
  std::vector<StraightPiece> pieces;
  std::size_t next = 0;
  for (std::size_t first = 0; first < steady.size(); first = next) {
    next = first + 1;
    if (!steady[first]) {
      continue;
    }
    while (next < steady.size() && steady[next] &&
           std::abs(travel.yaw_rad[next] - travel.yaw_rad[first]) < most_turn_rad &&
           travel.way_m[next] - travel.way_m[first] < params.longest_m) {
      ++next;
    }
    const std::size_t last = next - 1;
    const double length_m = travel.way_m[last] - travel.way_m[first];
    const Eigen::Vector2d chord =
        odom_from_robot[last].translation() - odom_from_robot[first].translation();
    if (length_m < params.shortest_m || chord.norm() < kLeastChord * length_m) {
      continue;
    }
    const double chord_rad = std::atan2(chord.y(), chord.x());
    pieces.push_back({.first = first,
                      .last = last,
                      .way_m = std::midpoint(travel.way_m[first], travel.way_m[last]),
                      .length_m = length_m,
                      .axis_rad = axis_beside(mean_yaw_rad(travel, first, last), chord_rad)});
  }
  return pieces;
}

}  // namespace sketchloc
