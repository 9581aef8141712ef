#include "registration/train/driven_submap.hpp"

#include <algorithm>

namespace sketchloc {

std::size_t draw_index(std::size_t count, Rng& rng) {
  return std::min(static_cast<std::size_t>(uniform(rng) * static_cast<double>(count)), count - 1);
}

std::vector<PlacedScan> draw_driven_submap(const MetricTrajectory& drive,
                                           std::span<const Scan> scans, std::size_t present,
                                           const DrivenSubmapParams& params, Rng& rng) {
  const int choice = params.max_scans - params.min_scans + 1;
  const std::size_t wanted = static_cast<std::size_t>(params.min_scans) +
                             draw_index(static_cast<std::size_t>(choice), rng);
  std::vector<PlacedScan> submap = {{.scan = &scans[present]}};
  Se2 robot_from_then;
  std::size_t last = present;
  for (std::size_t i = present; i-- > 0 && submap.size() < wanted;) {
    const Se2 last_from_here = drive[last].pose.inverse() * drive[i].pose;
    if (last_from_here.translation().norm() < params.scan_spacing_m) {
      continue;
    }
    robot_from_then = robot_from_then * sample_increment(last_from_here, params.noise, rng);
    submap.push_back({.scan = &scans[i], .robot_from_then = robot_from_then});
    last = i;
  }
  return submap;
}

}  // namespace sketchloc
