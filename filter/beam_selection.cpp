#include "filter/beam_selection.hpp"

#include <algorithm>
#include <cmath>

#include "motion/validate.hpp"

namespace sketchloc {

void validate(const BeamSelection& selection) {
  require_in_range("beams", selection.beams, 1, 4096);
  require_above("max_range_m", selection.max_range_m, 0.0);
}

void select_beams(std::vector<SelectedBeam>& selected, const Scan& scan,
                  const BeamSelection& selection) {
  selected.clear();
  const auto readings = static_cast<int>(scan.ranges_m.size());
  const int sectors = std::min(selection.beams, readings);
  const double most_m = std::min(selection.max_range_m, scan.max_range_m);
  for (int sector = 0; sector < sectors; ++sector) {
    const auto middle = static_cast<std::size_t>((2 * sector + 1) * readings / (2 * sectors));
    const double range_m = scan.ranges_m[middle];
    if (!scan.is_in_reach_or_beyond(middle)) {
      continue;
    }
    const bool returned = scan.is_return(middle) && range_m <= most_m;
    const double angle_rad = scan.angle_rad(middle);
    const Eigen::Vector2d direction(std::cos(angle_rad), std::sin(angle_rad));
    selected.push_back(
        {.end_in_robot = scan.robot_from_laser * ((returned ? range_m : most_m) * direction),
         .returned = returned});
  }
}

}  // namespace sketchloc
