#include "filter/contradiction.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "motion/validate.hpp"

namespace sketchloc {
namespace {

struct Count {
  int seen = 0;
  int contradicted = 0;
};

/// How far a scan surely saw in a direction: the nearest return of the beam and its neighbours.
/// None where one of them has no return, or lies beyond the field of view.
std::optional<double> free_range_m(const Scan& scan, double bearing_rad, int neighbours) {
  const auto beams = static_cast<int>(scan.ranges_m.size());
  constexpr double kTurn = 2.0 * std::numbers::pi;
  double offset_rad = std::fmod(bearing_rad - scan.first_angle_rad, kTurn);
  offset_rad += offset_rad < -0.5 * std::abs(scan.angle_step_rad) ? kTurn : 0.0;
  const double place = std::round(offset_rad / scan.angle_step_rad);
  if (!(place >= neighbours) || !(place < beams - neighbours)) {
    return std::nullopt;
  }
  const int middle = static_cast<int>(place);
  double nearest_m = scan.max_range_m;
  for (int beam = middle - neighbours; beam <= middle + neighbours; ++beam) {
    const auto index = static_cast<std::size_t>(beam);
    if (!scan.is_return(index)) {
      return std::nullopt;
    }
    nearest_m = std::min(nearest_m, static_cast<double>(scan.ranges_m[index]));
  }
  return nearest_m;
}

/// The end points of one scan against the free space of another.
Count count_against(const Scan& scan, const Scan& other, const Se2& other_from_robot,
                    const ContradictionParams& params) {
  const Se2 other_laser_from_laser =
      other.robot_from_laser.inverse() * other_from_robot * scan.robot_from_laser;
  Count count;
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    if (!scan.is_return(beam)) {
      continue;
    }
    const double angle_rad = scan.first_angle_rad + static_cast<double>(beam) * scan.angle_step_rad;
    const Eigen::Vector2d end =
        other_laser_from_laser *
        Eigen::Vector2d(scan.ranges_m[beam] *
                        Eigen::Vector2d(std::cos(angle_rad), std::sin(angle_rad)));
    const double away_m = end.norm();
    const auto free_m = free_range_m(other, std::atan2(end.y(), end.x()), params.neighbours);
    if (free_m) {
      ++count.seen;
      count.contradicted +=
          away_m < *free_m - params.tolerance_m - params.tolerance_per_m * away_m ? 1 : 0;
    }
  }
  return count;
}

}  // namespace

void validate(const ContradictionParams& params) {
  require_at_least("tolerance_m", params.tolerance_m, 0.0);
  require_at_least("tolerance_per_m", params.tolerance_per_m, 0.0);
  require_in_range("neighbours", params.neighbours, 0, 100);
}

double contradiction(const Scan& now, const Scan& before, const Se2& before_from_now,
                     const ContradictionParams& params) {
  const Count forth = count_against(now, before, before_from_now, params);
  const Count back = count_against(before, now, before_from_now.inverse(), params);
  const int seen = forth.seen + back.seen;
  return seen > 0 ? static_cast<double>(forth.contradicted + back.contradicted) / seen : 0.0;
}

}  // namespace sketchloc
