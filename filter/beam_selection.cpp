#include "filter/beam_selection.hpp"

#include <algorithm>
#include <cmath>

#include "motion/validate.hpp"

namespace sketchloc {
namespace {

constexpr double kLeastRangeM = 1e-3;

}  // namespace

void validate(const BeamSelection& selection) {
  require_in_range("beams", selection.beams, 1, 1024);
  require_above("max_range_m", selection.max_range_m, 0.0);
}

void select_beams(std::vector<Beam>& beams, const Scan& scan, const BeamSelection& selection) {
  beams.clear();
  const auto readings = static_cast<int>(scan.ranges_m.size());
  const int sectors = std::min(selection.beams, readings);
  for (int sector = 0; sector < sectors; ++sector) {
    const auto middle = static_cast<std::size_t>((2 * sector + 1) * readings / (2 * sectors));
    const double range_m = scan.ranges_m[middle];
    if (!scan.is_return(middle) || range_m > selection.max_range_m || range_m <= 0.0) {
      continue;
    }
    const double angle_rad = scan.angle_rad(middle);
    const Eigen::Vector2d end_in_robot =
        scan.robot_from_laser *
        Eigen::Vector2d(range_m * std::cos(angle_rad), range_m * std::sin(angle_rad));
    beams.push_back(
        {.bearing_rad = static_cast<float>(std::atan2(end_in_robot.y(), end_in_robot.x())),
         .range_m = static_cast<float>(std::max(end_in_robot.norm(), kLeastRangeM))});
  }
}

}  // namespace sketchloc
