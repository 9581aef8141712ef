#include "datasets/sim/detail/wall_tracing.hpp"

#include <array>
#include <utility>

namespace sketchloc::detail {
namespace {

/// Clockwise from the top, as in [ZhangSuen84].
constexpr std::array<Cell, 8> kRing = {
    {{0, 1}, {1, 1}, {1, 0}, {1, -1}, {0, -1}, {-1, -1}, {-1, 0}, {-1, 1}}};

bool is_set(const Grid<std::uint8_t>& mask, const Cell& cell) {
  return mask.contains(cell) && mask.at(cell) != 0;
}

std::array<bool, 8> ring_of(const Grid<std::uint8_t>& mask, const Cell& cell) {
  std::array<bool, 8> ring{};
  for (std::size_t i = 0; i < 8; ++i) {
    ring[i] = is_set(mask, {cell.column + kRing[i].column, cell.row + kRing[i].row});
  }
  return ring;
}

/// Whether a cell can go in one of the two half-passes.
bool removable(const std::array<bool, 8>& ring, bool first_half) {
  int neighbours = 0;
  int rises = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    neighbours += ring[i] ? 1 : 0;
    rises += !ring[i] && ring[(i + 1) % 8] ? 1 : 0;
  }
  const bool top = ring[0];
  const bool right = ring[2];
  const bool bottom = ring[4];
  const bool left = ring[6];
  const bool open = first_half ? !(top && right && bottom) && !(right && bottom && left)
                               : !(top && right && left) && !(top && bottom && left);
  return neighbours >= 2 && neighbours <= 6 && rises == 1 && open;
}

std::vector<Cell> set_neighbours(const Grid<std::uint8_t>& lines, const Cell& cell) {
  std::vector<Cell> found;
  const std::array<bool, 8> ring = ring_of(lines, cell);
  for (std::size_t i = 0; i < 8; ++i) {
    // a diagonal beside a set edge neighbour is reached through that one
    const bool diagonal = i % 2 == 1;
    const bool shadowed = diagonal && (ring[i - 1] || ring[(i + 1) % 8]);
    if (ring[i] && !shadowed) {
      found.push_back({cell.column + kRing[i].column, cell.row + kRing[i].row});
    }
  }
  return found;
}

/// Follows one line from a node over free cells until the next node or its own end.
Polyline follow(const Grid<std::uint8_t>& lines, const Cell& node, Cell here,
                Grid<std::uint8_t>& visited) {
  Polyline line{centre_of(node)};
  Cell previous = node;
  while (true) {
    line.push_back(centre_of(here));
    const std::vector<Cell> neighbours = set_neighbours(lines, here);
    if (neighbours.size() != 2) {
      return line;  // an end or a junction
    }
    if (visited.at(here) != 0) {
      return line;
    }
    visited.at(here) = 1;
    const Cell next = neighbours[0] == previous ? neighbours[1] : neighbours[0];
    previous = std::exchange(here, next);
  }
}

template <typename Visit>
void for_each_cell(const Grid<std::uint8_t>& lines, const Visit& visit) {
  for (int row = 0; row < lines.height(); ++row) {
    for (int column = 0; column < lines.width(); ++column) {
      if (lines.at({column, row}) != 0) {
        visit(Cell{column, row});
      }
    }
  }
}

}  // namespace

Grid<std::uint8_t> thin(Grid<std::uint8_t> mask) {
  bool changed = true;
  while (changed) {
    changed = false;
    for (const bool first_half : {true, false}) {
      std::vector<Cell> removed;
      for_each_cell(mask, [&](const Cell& cell) {
        if (removable(ring_of(mask, cell), first_half)) {
          removed.push_back(cell);
        }
      });
      for (const Cell& cell : removed) {
        mask.at(cell) = 0;
      }
      changed = changed || !removed.empty();
    }
  }
  return mask;
}

std::vector<Polyline> trace_lines(const Grid<std::uint8_t>& lines) {
  std::vector<Polyline> traced;
  Grid<std::uint8_t> visited(lines.width(), lines.height());
  for_each_cell(lines, [&](const Cell& node) {
    const std::vector<Cell> neighbours = set_neighbours(lines, node);
    if (neighbours.size() == 2) {
      return;
    }
    visited.at(node) = 1;
    for (const Cell& start : neighbours) {
      const bool towards_node = set_neighbours(lines, start).size() != 2;
      const bool first_of_two =
          std::pair(node.row, node.column) < std::pair(start.row, start.column);
      if (towards_node ? first_of_two : visited.at(start) == 0) {
        traced.push_back(follow(lines, node, start, visited));
      }
    }
  });
  for_each_cell(lines, [&](const Cell& cell) {  // what is left are loops
    const std::vector<Cell> neighbours = set_neighbours(lines, cell);
    if (visited.at(cell) == 0 && neighbours.size() == 2) {
      visited.at(cell) = 1;
      traced.push_back(follow(lines, cell, neighbours[0], visited));
    }
  });
  return traced;
}

}  // namespace sketchloc::detail
