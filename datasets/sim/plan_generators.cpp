#include "datasets/sim/plan_generators.hpp"

#include <algorithm>
#include <cmath>

#include "datasets/sim/detail/plan_builder.hpp"
#include "motion/check.hpp"

namespace sketchloc {
namespace {

using detail::Passage;
using detail::PassageRule;
using Rooms = std::vector<Room>;

void append(Rooms& rooms, const Rooms& more) {
  rooms.insert(rooms.end(), more.begin(), more.end());
}

Room corridor(double left, double bottom, double right, double top) {
  return {.use = Room::Use::Corridor, .box_in_world = {{left, bottom}, {right, top}}};
}

/// Rooms side by side along x (axis 0) or y (axis 1) that fill a strip.
Rooms row_of_rooms(const PlaneBox& strip, int axis, double min_m, double max_m, Rng& rng) {
  Rooms rooms;
  const std::vector<double> cuts =
      detail::random_cuts(strip.low(axis), strip.high(axis), min_m, max_m, rng);
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    Room room{.box_in_world = strip};
    room.box_in_world.low(axis) = cuts[i];
    room.box_in_world.high(axis) = cuts[i + 1];
    rooms.push_back(room);
  }
  return rooms;
}

/// Corridors run into each other; rooms have a door to the corridor, now and then to a neighbour.
PassageRule door_to_corridor(double neighbour_door_share, Rng& rng) {
  return [neighbour_door_share, &rng](const Room& first, const Room& second) {
    const bool first_is_way = first.use != Room::Use::Room;
    const bool second_is_way = second.use != Room::Use::Room;
    if (first_is_way && second_is_way) {
      return Passage::Open;
    }
    const double share = first_is_way || second_is_way ? 0.9 : neighbour_door_share;
    return uniform(rng) < share ? Passage::Door : Passage::Wall;
  };
}

/// Leaves out a room now and then, so that outlines are not all rectangles.
void leave_out_some(Rooms& rooms, double share, Rng& rng) {
  std::erase_if(
      rooms, [&](const Room& room) { return room.use == Room::Use::Room && uniform(rng) < share; });
}

/// A straight corridor with a row of rooms on either side.
Rooms straight_office(double length_m, double depth_m, double corridor_m, Rng& rng) {
  const double second_row = depth_m + corridor_m;
  Rooms rooms{corridor(0.0, depth_m, length_m, second_row)};
  append(rooms, row_of_rooms({{0.0, 0.0}, {length_m, depth_m}}, 0, 2.8, 6.5, rng));
  append(rooms, row_of_rooms({{0.0, second_row}, {length_m, second_row + uniform(3.5, 6.0, rng)}},
                             0, 2.8, 6.5, rng));
  return rooms;
}

/// What a ring of corridors surrounds: rooms, cut by cross corridors where it is wide.
Rooms office_core(const PlaneBox& core, double corridor_m, Rng& rng) {
  const double width_m = core.size().x();
  const int parts = width_m > 22.0 ? 3 : (width_m > 12.0 && uniform(rng) < 0.6 ? 2 : 1);
  const double part_m = (width_m - (parts - 1) * corridor_m) / parts;
  Rooms rooms;
  for (int part = 0; part < parts; ++part) {
    const double left = core.low.x() + part * (part_m + corridor_m);
    const double right = left + part_m;
    append(rooms, detail::subdivide({{left, core.low.y()}, {right, core.high.y()}}, 2.6,
                                    uniform(20.0, 45.0, rng), rng));
    if (part + 1 < parts) {
      rooms.push_back(corridor(right, core.low.y(), right + corridor_m, core.high.y()));
    }
  }
  return rooms;
}

/// Rooms around a ring of corridors around a core.
Rooms ring_office(double length_m, double height_m, double depth_m, double corridor_m, Rng& rng) {
  const double left = depth_m;
  const double right = length_m - depth_m;
  const double bottom = depth_m;
  const double top = height_m - depth_m;
  const PlaneBox core = {{left + corridor_m, bottom + corridor_m},
                         {right - corridor_m, top - corridor_m}};
  Rooms rooms{corridor(left, bottom, right, core.low.y()),
              corridor(left, core.high.y(), right, top),
              corridor(left, core.low.y(), core.low.x(), core.high.y()),
              corridor(core.high.x(), core.low.y(), right, core.high.y())};
  append(rooms, row_of_rooms({{0.0, 0.0}, {length_m, bottom}}, 0, 3.0, 6.5, rng));
  append(rooms, row_of_rooms({{0.0, top}, {length_m, height_m}}, 0, 3.0, 6.5, rng));
  append(rooms, row_of_rooms({{0.0, bottom}, {left, top}}, 1, 3.0, 6.0, rng));
  append(rooms, row_of_rooms({{right, bottom}, {length_m, top}}, 1, 3.0, 6.0, rng));
  append(rooms, office_core(core, corridor_m, rng));
  return rooms;
}

/// Rack rows that fill a hall: aisles between rows, cross aisles between blocks.
void add_racks(FloorPlan& plan, const PlaneBox& hall, Rng& rng) {
  const double aisle_m = uniform(2.2, 3.2, rng);
  const double cross_aisle_m = uniform(2.6, 4.0, rng);
  const double rack_m = uniform(1.0, 2.2, rng);
  const double length_m = uniform(8.0, 16.0, rng);
  const Eigen::Vector2d free_m = hall.size() - Eigen::Vector2d(2.0 * cross_aisle_m, 2.0 * aisle_m);
  const int columns =
      std::max(1, static_cast<int>((free_m.x() + cross_aisle_m) / (length_m + cross_aisle_m)));
  const int rows = std::max(1, static_cast<int>((free_m.y() + aisle_m) / (rack_m + aisle_m)));
  const double pitch_x = (free_m.x() + cross_aisle_m) / columns;
  const double pitch_y = (free_m.y() + aisle_m) / rows;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      if (uniform(rng) < 0.04) {
        continue;  // a place without a rack
      }
      const Eigen::Vector2d half_m(0.5 * (pitch_x - cross_aisle_m), 0.5 * rack_m);
      const Eigen::Vector2d corner =
          hall.low + Eigen::Vector2d(cross_aisle_m + column * pitch_x, aisle_m + row * pitch_y);
      plan.furniture.push_back(
          {.centre_in_world = corner + half_m, .half_size_m = half_m, .structural = true});
    }
  }
}

/// Pallets left in the aisles, which nobody draws.
void add_pallets(FloorPlan& plan, const PlaneBox& hall, Rng& rng) {
  const int pallets = static_cast<int>(hall.size().prod() / 60.0);
  for (int i = 0; i < pallets; ++i) {
    const Eigen::Vector2d centre(uniform(hall.low.x() + 0.6, hall.high.x() - 0.6, rng),
                                 uniform(hall.low.y() + 0.6, hall.high.y() - 0.6, rng));
    plan.furniture.push_back(
        {.centre_in_world = centre, .half_size_m = {0.5, 0.4}, .yaw_rad = uniform(-0.3, 0.3, rng)});
  }
}

}  // namespace

FloorPlan make_home(Rng& rng) {
  const double width_m = uniform(8.0, 14.5, rng);
  const double height_m = uniform(7.0, 11.0, rng);
  const double room_area_m2 = uniform(12.0, 20.0, rng);
  Rooms rooms;
  if (uniform(rng) < 0.7) {
    const double corridor_m = uniform(1.2, 1.8, rng);
    const double bottom = uniform(0.35, 0.6, rng) * (height_m - corridor_m);
    const double end = uniform(rng) < 0.5 ? width_m : width_m - uniform(2.6, 4.0, rng);
    rooms.push_back(corridor(0.0, bottom, end, bottom + corridor_m));
    append(rooms, detail::subdivide({{0.0, 0.0}, {end, bottom}}, 2.4, room_area_m2, rng));
    append(rooms, detail::subdivide({{0.0, bottom + corridor_m}, {end, height_m}}, 2.4,
                                    room_area_m2, rng));
    if (end < width_m) {
      append(rooms, detail::subdivide({{end, 0.0}, {width_m, height_m}}, 2.4, room_area_m2, rng));
    }
  } else {
    rooms = detail::subdivide({{0.0, 0.0}, {width_m, height_m}}, 2.4, room_area_m2, rng);
  }
  leave_out_some(rooms, 0.08, rng);
  FloorPlan plan = detail::plan_from_rooms(
      std::move(rooms), door_to_corridor(0.25, rng),
      {.inner_thickness_m = 0.12, .outer_thickness_m = 0.3, .door_width_m = 0.9}, rng);
  detail::furnish(plan, 0.25, rng);
  return plan;
}

FloorPlan make_office(Rng& rng) {
  const double length_m = uniform(20.0, 45.0, rng);
  const double depth_m = uniform(3.5, 6.0, rng);
  const double corridor_m = uniform(1.6, 2.8, rng);
  const double ring_height_m = 2.0 * (depth_m + corridor_m) + uniform(3.0, 14.0, rng);
  const bool ring = length_m > 24.0 && uniform(rng) < 0.7;
  Rooms rooms = ring ? ring_office(length_m, ring_height_m, depth_m, corridor_m, rng)
                     : straight_office(length_m, depth_m, corridor_m, rng);
  leave_out_some(rooms, 0.06, rng);
  FloorPlan plan = detail::plan_from_rooms(std::move(rooms), door_to_corridor(0.12, rng),
                                           {.glass_share = 0.04}, rng);
  detail::furnish(plan, 0.2, rng);
  return plan;
}

FloorPlan make_warehouse(Rng& rng) {
  const double length_m = uniform(30.0, 55.0, rng);
  const double height_m = uniform(18.0, 32.0, rng);
  const double office_m = uniform(3.5, 5.0, rng);
  const PlaneBox hall = {{0.0, office_m}, {length_m, office_m + height_m}};
  Rooms rooms{{.use = Room::Use::Hall, .box_in_world = hall}};
  append(rooms, row_of_rooms({{0.0, 0.0}, {length_m, office_m}}, 0, 4.0, 9.0, rng));
  leave_out_some(rooms, 0.3, rng);
  FloorPlan plan = detail::plan_from_rooms(std::move(rooms), door_to_corridor(0.1, rng),
                                           {.outer_thickness_m = 0.3, .door_width_m = 1.4}, rng);
  detail::furnish(plan, 0.15, rng);
  add_racks(plan, hall, rng);
  add_pallets(plan, hall, rng);
  return plan;
}

FloorPlan make_plan(BuildingKind kind, Rng& rng) {
  switch (kind) {
    case BuildingKind::Home:
      return make_home(rng);
    case BuildingKind::Office:
      return make_office(rng);
    case BuildingKind::Warehouse:
      return make_warehouse(rng);
  }
  check(false, "unknown kind of building");
  return {};
}

}  // namespace sketchloc
