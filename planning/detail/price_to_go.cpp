#include "planning/detail/price_to_go.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <vector>

namespace sketchloc::detail {

Grid<float> price_to_go_m(const FreeSpace& space, const Eigen::Vector2d& goal_in_sketch) {
  using Candidate = std::tuple<float, int, int>;  // price, row, column
  Grid<float> price_m(space.width_px(), space.height_px(), std::numeric_limits<float>::infinity());
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> open;
  const Cell goal = cell_at(goal_in_sketch);
  price_m.at(goal) = 0.0F;
  open.emplace(0.0F, goal.row, goal.column);
  while (!open.empty()) {
    const auto [here_m, row, column] = open.top();
    open.pop();
    const Cell cell{column, row};
    if (here_m > price_m.at(cell)) {
      continue;
    }
    for (int up = -1; up <= 1; ++up) {
      for (int across = -1; across <= 1; ++across) {
        const Cell next{column + across, row + up};
        if (!space.is_free(next)) {
          continue;
        }
        const double step_m =
            0.5 * std::hypot(up, across) * (space.cost_m_per_px(cell) + space.cost_m_per_px(next));
        const float there_m = here_m + static_cast<float>(step_m);
        if (there_m < price_m.at(next)) {
          price_m.at(next) = there_m;
          open.emplace(there_m, next.row, next.column);
        }
      }
    }
  }
  return price_m;
}

}  // namespace sketchloc::detail
