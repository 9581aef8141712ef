#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "datasets/sim/detail/pen.hpp"

namespace sketchloc::detail {
namespace {

constexpr double kSamePlace_m = 0.01;
constexpr double kStraightOn = -0.95;  ///< cosine between the directions away from the joint

/// One end of one wall; `index` = 2 * wall + (0 at its start, 1 at its end).
struct WallEnd {
  std::size_t index;
  Eigen::Vector2d direction_away;
};

using Links = std::vector<std::optional<std::size_t>>;  ///< partner of each wall end

void link(std::size_t first, std::size_t second, Links& links) {
  links[first] = second;
  links[second] = first;
}

/// Links the free ends at one place, straight ones first.
void link_ends(const std::vector<WallEnd>& ends, double one_go_share, Links& links, Rng& rng) {
  for (const bool straight : {true, false}) {
    for (std::size_t i = 0; i < ends.size(); ++i) {
      for (std::size_t j = i + 1; j < ends.size(); ++j) {
        const double cosine = ends[i].direction_away.dot(ends[j].direction_away);
        const bool wanted = straight ? cosine < kStraightOn : uniform(rng) < one_go_share;
        if (wanted && !links[ends[i].index] && !links[ends[j].index]) {
          link(ends[i].index, ends[j].index, links);
        }
      }
    }
  }
}

Links link_walls(std::span<const Wall> walls, double one_go_share, Rng& rng) {
  std::map<std::array<long, 2>, std::vector<WallEnd>> places;
  const auto add = [&](const Eigen::Vector2d& at, const Eigen::Vector2d& other, std::size_t index) {
    const std::array<long, 2> key = {std::lround(at.x() / kSamePlace_m),
                                     std::lround(at.y() / kSamePlace_m)};
    places[key].push_back({index, (other - at).normalized()});
  };
  for (std::size_t i = 0; i < walls.size(); ++i) {
    add(walls[i].from_in_world, walls[i].to_in_world, 2 * i);
    add(walls[i].to_in_world, walls[i].from_in_world, 2 * i + 1);
  }
  Links links(2 * walls.size());
  for (const auto& [place, ends] : places) {
    link_ends(ends, one_go_share, links, rng);
  }
  return links;
}

Eigen::Vector2d position(std::span<const Wall> walls, std::size_t end) {
  return end % 2 == 0 ? walls[end / 2].from_in_world : walls[end / 2].to_in_world;
}

/// Walks from a wall end along the links until the chain ends or closes.
Stroke walk(std::span<const Wall> walls, const Links& links, std::size_t start,
            std::vector<bool>& used) {
  Stroke stroke{position(walls, start)};
  std::optional<std::size_t> end = start;
  while (end && !used[*end / 2]) {
    used[*end / 2] = true;
    const std::size_t far_end = *end ^ 1;
    stroke.push_back(position(walls, far_end));
    end = links[far_end];
  }
  return stroke;
}

/// Moves the jambs of the doors, so that gaps come out wider or narrower.
std::vector<Wall> with_other_door_widths(const FloorPlan& plan, double log_sigma, Rng& rng) {
  std::vector<Wall> walls = plan.walls;
  for (const Door& door : plan.doors) {
    const Eigen::Vector2d centre = door.centre_in_world();
    const double factor = std::clamp(std::exp(gaussian(log_sigma, rng)), 0.5, 1.6);
    for (const Eigen::Vector2d& jamb : {door.from_in_world, door.to_in_world}) {
      const Eigen::Vector2d moved = centre + factor * (jamb - centre);
      for (Wall& wall : walls) {
        for (Eigen::Vector2d* end : {&wall.from_in_world, &wall.to_in_world}) {
          if ((*end - jamb).norm() < kSamePlace_m) {
            *end = moved;
          }
        }
      }
    }
  }
  return walls;
}

Stroke closed_outline(std::vector<Eigen::Vector2d> corners) {
  corners.push_back(corners.front());
  return corners;
}

Stroke thick_outline(const Wall& wall, double width_m) {
  const Eigen::Vector2d along = wall.to_in_world - wall.from_in_world;
  const Furniture body = {.centre_in_world = 0.5 * (wall.from_in_world + wall.to_in_world),
                          .half_size_m = {0.5 * along.norm(), 0.5 * width_m},
                          .yaw_rad = std::atan2(along.y(), along.x())};
  return closed_outline(body.corners_in_world());
}

void append_furniture(const FloorPlan& plan, const PenParams& pen, std::vector<Stroke>& strokes,
                      Rng& rng) {
  for (const Furniture& item : plan.furniture) {
    if (item.structural || uniform(rng) < pen.furniture_share) {
      strokes.push_back(closed_outline(item.corners_in_world()));
    }
  }
}

}  // namespace

std::vector<Stroke> chain_walls(std::span<const Wall> walls, double one_go_share, Rng& rng) {
  const Links links = link_walls(walls, one_go_share, rng);
  std::vector<bool> used(walls.size(), false);
  std::vector<Stroke> strokes;
  for (const bool from_free_end : {true, false}) {  // what is left after the first round are loops
    for (std::size_t end = 0; end < links.size(); ++end) {
      if (!used[end / 2] && (!from_free_end || !links[end])) {
        strokes.push_back(walk(walls, links, end, used));
      }
    }
  }
  return strokes;
}

std::vector<Stroke> choose_strokes(const FloorPlan& plan, const PenParams& pen, Rng& rng) {
  std::vector<Stroke> strokes;
  std::vector<Wall> lines;
  for (const Wall& wall : with_other_door_widths(plan, pen.door_log_sigma, rng)) {
    const bool inner = wall.thickness_m < 0.2;
    const bool left_out = uniform(rng) < pen.left_out_share;
    const bool thick = uniform(rng) < pen.thick_wall_share;
    const double width_m = pen.thick_wall_m * uniform(0.5, 1.5, rng);
    if (wall.length_m() < kSamePlace_m || (inner && left_out)) {
      continue;
    }
    if (thick && wall.length_m() > 1.0) {
      strokes.push_back(thick_outline(wall, width_m));
    } else {
      lines.push_back(wall);
    }
  }
  for (const Door& door : plan.doors) {
    if (uniform(rng) < pen.shut_door_share) {
      lines.push_back({.from_in_world = door.from_in_world, .to_in_world = door.to_in_world});
    }
  }
  const std::vector<Stroke> chains = chain_walls(lines, pen.one_go_share, rng);
  strokes.insert(strokes.end(), chains.begin(), chains.end());
  append_furniture(plan, pen, strokes, rng);
  return strokes;
}

}  // namespace sketchloc::detail
