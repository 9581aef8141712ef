#include "filter/beam_selection.hpp"

#include <algorithm>
#include <cmath>

#include "motion/validate.hpp"

namespace sketchloc {

void validate(const BeamSelection& selection) {
  require_in_range("beams", selection.beams, 1, 4096);
  require_above("max_range_m", selection.max_range_m, 0.0);
}

void select_end_points(std::vector<Eigen::Vector2d>& ends_in_robot, const Scan& scan,
                       const BeamSelection& selection) {
  ends_in_robot.clear();
  const auto readings = static_cast<int>(scan.ranges_m.size());
  const int sectors = std::min(selection.beams, readings);
  for (int sector = 0; sector < sectors; ++sector) {
    const auto middle = static_cast<std::size_t>((2 * sector + 1) * readings / (2 * sectors));
    const double range_m = scan.ranges_m[middle];
    if (!scan.is_return(middle) || range_m > selection.max_range_m || range_m <= 0.0) {
      continue;
    }
    const double angle_rad = scan.angle_rad(middle);
    ends_in_robot.push_back(scan.robot_from_laser * Eigen::Vector2d(range_m * std::cos(angle_rad),
                                                                    range_m * std::sin(angle_rad)));
  }
}

}  // namespace sketchloc
