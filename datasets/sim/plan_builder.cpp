#include "datasets/sim/detail/plan_builder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "motion/check.hpp"

namespace sketchloc::detail {
namespace {

constexpr double kJamb_m = 0.25;  ///< least wall beside a door

/// Union-find over rooms: which ones can be reached from each other.
class Reachability {
 public:
  explicit Reachability(std::size_t rooms) : parent_(rooms) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  /// False if they were joined already.
  bool join(std::size_t first, std::size_t second) {
    const std::size_t a = root(first);
    const std::size_t b = root(second);
    parent_[a] = b;
    return a != b;
  }

 private:
  std::size_t root(std::size_t room) const {
    while (parent_[room] != room) {
      room = parent_[room];
    }
    return room;
  }
  std::vector<std::size_t> parent_;
};

template <typename T>
void shuffle(std::vector<T>& items, Rng& rng) {
  for (std::size_t i = items.size(); i > 1; --i) {
    const auto other = static_cast<std::size_t>(uniform(rng) * static_cast<double>(i));
    std::swap(items[i - 1], items[other]);
  }
}

/// The rule's passages, one per edge; at most one door between the same two rooms.
std::vector<Passage> choose_passages(std::span<const Room> rooms, std::span<const RoomEdge> edges,
                                     const PassageRule& rule, const WallStyle& style, Rng& rng) {
  const double least_length_m = style.door_width_m + 2.0 * kJamb_m;
  std::vector<Passage> passages(edges.size(), Passage::Wall);
  Reachability reachable(rooms.size());
  std::vector<std::size_t> order(edges.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  shuffle(order, rng);
  for (const std::size_t i : order) {
    if (edges[i].outer() || edges[i].length_m() < least_length_m) {
      continue;
    }
    passages[i] = rule(rooms[edges[i].first], rooms[edges[i].second]);
    if (passages[i] != Passage::Wall) {
      reachable.join(edges[i].first, edges[i].second);
    }
  }
  for (const std::size_t i : order) {
    const bool usable = !edges[i].outer() && edges[i].length_m() >= least_length_m;
    if (usable && passages[i] == Passage::Wall && reachable.join(edges[i].first, edges[i].second)) {
      passages[i] = Passage::Door;
    }
  }
  return passages;
}

void add_wall_with_door(FloorPlan& plan, const Wall& whole, double door_width_m, Rng& rng) {
  const Eigen::Vector2d direction = (whole.to_in_world - whole.from_in_world).normalized();
  const double start_m =
      uniform(kJamb_m, std::max(kJamb_m, whole.length_m() - door_width_m - kJamb_m), rng);
  const Door door = {whole.from_in_world + start_m * direction,
                     whole.from_in_world + (start_m + door_width_m) * direction};
  Wall before = whole;
  before.to_in_world = door.from_in_world;
  Wall after = whole;
  after.from_in_world = door.to_in_world;
  plan.walls.push_back(before);
  plan.walls.push_back(after);
  plan.doors.push_back(door);
}

bool clear_of_doors(const Furniture& item, std::span<const Door> doors) {
  const double reach_m = item.half_size_m.norm() + 0.6;
  return std::all_of(doors.begin(), doors.end(), [&](const Door& door) {
    return (door.centre_in_world() - item.centre_in_world).norm() > reach_m;
  });
}

/// A desk or cabinet against a wall, or (one in four) a table somewhere on the floor.
Furniture random_item(const PlaneBox& room, Rng& rng) {
  const bool on_floor = uniform(rng) < 0.25;
  Furniture item{.half_size_m = {uniform(0.3, 0.9, rng), uniform(0.2, 0.4, rng)}};
  const int wall_axis = uniform(rng) < 0.5 ? 0 : 1;  // the axis the item is pushed along
  if (wall_axis == 0) {
    std::swap(item.half_size_m.x(), item.half_size_m.y());
  }
  const PlaneBox inside = {room.low + item.half_size_m + Eigen::Vector2d::Constant(0.15),
                           room.high - item.half_size_m - Eigen::Vector2d::Constant(0.15)};
  for (int axis = 0; axis < 2; ++axis) {
    item.centre_in_world(axis) = uniform(inside.low(axis), inside.high(axis), rng);
  }
  if (on_floor) {
    item.yaw_rad = uniform(-0.5, 0.5, rng);
  } else {
    item.centre_in_world(wall_axis) =
        uniform(rng) < 0.5 ? inside.low(wall_axis) : inside.high(wall_axis);
  }
  return item;
}

}  // namespace

FloorPlan plan_from_rooms(std::vector<Room> rooms, const PassageRule& rule, const WallStyle& style,
                          Rng& rng) {
  const std::vector<RoomEdge> edges = find_edges(rooms);
  const std::vector<Passage> passages = choose_passages(rooms, edges, rule, style, rng);
  FloorPlan plan{.rooms = std::move(rooms)};
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const bool outer = edges[i].outer();
    const Wall wall = {.from_in_world = edges[i].from_in_world,
                       .to_in_world = edges[i].to_in_world,
                       .thickness_m = outer ? style.outer_thickness_m : style.inner_thickness_m,
                       .glass = !outer && uniform(rng) < style.glass_share};
    if (passages[i] == Passage::Wall) {
      plan.walls.push_back(wall);
    } else if (passages[i] == Passage::Door) {
      add_wall_with_door(plan, wall, style.door_width_m, rng);
    }
  }
  return plan;
}

std::vector<Room> subdivide(const PlaneBox& box, double min_side_m, double max_area_m2, Rng& rng) {
  const Eigen::Vector2d size = box.size();
  const int axis = size.x() > size.y() ? 0 : 1;
  const bool small_enough = size.prod() <= max_area_m2 * uniform(0.7, 1.2, rng);
  if (small_enough || size(axis) < 2.0 * min_side_m) {
    return {{.box_in_world = box}};
  }
  const double room_m = size(axis) - 2.0 * min_side_m;
  const double cut = box.low(axis) + min_side_m + room_m * uniform(0.2, 0.8, rng);
  PlaneBox low = box;
  PlaneBox high = box;
  low.high(axis) = cut;
  high.low(axis) = cut;
  std::vector<Room> rooms = subdivide(low, min_side_m, max_area_m2, rng);
  const std::vector<Room> others = subdivide(high, min_side_m, max_area_m2, rng);
  rooms.insert(rooms.end(), others.begin(), others.end());
  return rooms;
}

std::vector<double> random_cuts(double low, double high, double min_length, double max_length,
                                Rng& rng) {
  check(high > low && min_length > 0.0 && max_length >= min_length, "cuts need room");
  std::vector<double> lengths;
  double sum = 0.0;
  while (sum < high - low) {
    lengths.push_back(uniform(min_length, max_length, rng));
    sum += lengths.back();
  }
  if (lengths.size() > 1 && sum - lengths.back() > 0.75 * (high - low)) {
    sum -= lengths.back();  // stretching a little beats squeezing
    lengths.pop_back();
  }
  std::vector<double> cuts{low};
  for (const double length : lengths) {
    cuts.push_back(cuts.back() + length * (high - low) / sum);
  }
  cuts.back() = high;
  return cuts;
}

void furnish(FloorPlan& plan, double items_per_m2, Rng& rng) {
  for (const Room& room : plan.rooms) {
    const PlaneBox& box = room.box_in_world;
    const bool roomy = room.use == Room::Use::Room && box.size().minCoeff() > 2.2;
    if (!roomy) {
      continue;
    }
    const int items = static_cast<int>(std::lround(items_per_m2 * box.size().prod()));
    for (int i = 0; i < items; ++i) {
      const Furniture item = random_item(box, rng);
      if (clear_of_doors(item, plan.doors)) {
        plan.furniture.push_back(item);
      }
    }
  }
}

}  // namespace sketchloc::detail
