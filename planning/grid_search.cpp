#include "planning/grid_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

namespace sketchloc {
namespace {

constexpr std::array<Cell, 8> kNeighbours = {
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};
constexpr std::size_t kAskTimeEvery = 1024;

struct Candidate {
  float estimate_m;  ///< of the whole way through the cell
  Cell cell;
  bool operator>(const Candidate& other) const { return estimate_m > other.estimate_m; }
};

/// What is known of a cell.
struct Visit {
  float cost_m = std::numeric_limits<float>::infinity();
  std::int8_t from = -1;  ///< neighbour it was reached by; -1: not, or the start
  bool closed = false;
};

class Search {
 public:
  Search(const FreeSpace& space, const Cell& start, const Cell& goal, GridPrice price)
      : space_(space),
        price_(price),
        start_(start),
        goal_(goal),
        visits_(space.width_px(), space.height_px()) {
    visits_.at(start).cost_m = 0.0F;
    open_.push({at_least_m(start), start});
  }

  GridSearch::Status run(const TimeIsOver& out_of_time) {
    for (std::size_t expanded = 0; !open_.empty();) {
      const Cell cell = open_.top().cell;
      open_.pop();
      if (cell == goal_) {
        return GridSearch::Status::Found;
      }
      if (visits_.at(cell).closed) {
        continue;
      }
      if (++expanded % kAskTimeEvery == 0 && out_of_time && out_of_time()) {
        return GridSearch::Status::OutOfTime;
      }
      expand(cell);
    }
    return GridSearch::Status::NoPath;
  }

  PathPoints path() const {
    PathPoints points = {centre_of(goal_)};
    for (Cell cell = goal_; !(cell == start_);) {
      const Cell& step = kNeighbours[static_cast<std::size_t>(visits_.at(cell).from)];
      cell = {cell.column - step.column, cell.row - step.row};
      points.push_back(centre_of(cell));
    }
    std::ranges::reverse(points);
    return points;
  }

 private:
  /// No way to the goal costs less: straight and diagonal steps at the least price.
  float at_least_m(const Cell& cell) const {
    const int across = std::abs(cell.column - goal_.column);
    const int up = std::abs(cell.row - goal_.row);
    const double steps_px =
        std::max(across, up) + (std::numbers::sqrt2 - 1.0) * std::min(across, up);
    return static_cast<float>(steps_px * (price_ == GridPrice::Length
                                              ? space_.least_m_per_px()
                                              : space_.least_cost_m_per_px()));
  }

  double price_m_per_px(const Cell& cell) const {
    return price_ == GridPrice::Length ? space_.m_per_px(cell) : space_.cost_m_per_px(cell);
  }

  bool may_step(const Cell& from, const Cell& step) const {
    const Cell across{from.column + step.column, from.row};
    const Cell up{from.column, from.row + step.row};
    return space_.is_free(Cell{across.column, up.row}) &&
           (step.column == 0 || step.row == 0 || (space_.is_free(across) && space_.is_free(up)));
  }

  void expand(const Cell& cell) {
    Visit& here = visits_.at(cell);
    here.closed = true;
    const double price = price_m_per_px(cell);
    for (std::size_t k = 0; k < kNeighbours.size(); ++k) {
      const Cell& step = kNeighbours[k];
      const Cell next{cell.column + step.column, cell.row + step.row};
      if (!may_step(cell, step) || visits_.at(next).closed) {
        continue;
      }
      const double way_px = step.column != 0 && step.row != 0 ? std::numbers::sqrt2 : 1.0;
      const float cost_m =
          here.cost_m + static_cast<float>(0.5 * way_px * (price + price_m_per_px(next)));
      if (cost_m < visits_.at(next).cost_m) {
        visits_.at(next).cost_m = cost_m;
        visits_.at(next).from = static_cast<std::int8_t>(k);
        open_.push({cost_m + at_least_m(next), next});
      }
    }
  }

  const FreeSpace& space_;
  GridPrice price_;
  Cell start_;
  Cell goal_;
  Grid<Visit> visits_;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> open_;
};

}  // namespace

GridSearch search_grid(const FreeSpace& space, const Eigen::Vector2d& start_in_sketch,
                       const Eigen::Vector2d& goal_in_sketch, GridPrice price,
                       const TimeIsOver& out_of_time) {
  GridSearch result;
  if (!space.is_free(start_in_sketch) || !space.is_free(goal_in_sketch)) {
    return result;
  }
  Search search(space, cell_at(start_in_sketch), cell_at(goal_in_sketch), price);
  result.status = search.run(out_of_time);
  if (result.status == GridSearch::Status::Found) {
    result.path_in_sketch = search.path();
    // the centres of the end cells lie beside the ends, in the same px
    result.path_in_sketch.insert(result.path_in_sketch.begin(), start_in_sketch);
    result.path_in_sketch.push_back(goal_in_sketch);
  }
  return result;
}

}  // namespace sketchloc
