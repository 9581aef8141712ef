#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace sketchloc {

/// What kind of place a robot in a warehouse is at. [Topo20]
enum class PlaceLabel : std::uint8_t {
  Rackspace,     ///< in an aisle between racks
  Corridor,      ///< along racks or walls, from aisle to aisle
  Intersection,  ///< where ways meet, three or four
};
std::span<const std::pair<std::string_view, PlaceLabel>> names_of(PlaceLabel);

std::string_view name_of(PlaceLabel label);
/// Also "trisection", which is an intersection of three ways. None for any other word.
std::optional<PlaceLabel> place_label(std::string_view name);

}  // namespace sketchloc
