#include "datasets/place_label.hpp"

#include <array>

namespace sketchloc {
namespace {

constexpr std::array<std::pair<std::string_view, PlaceLabel>, 3> kNames = {
    {{"rackspace", PlaceLabel::Rackspace},
     {"corridor", PlaceLabel::Corridor},
     {"intersection", PlaceLabel::Intersection}}};

}  // namespace

std::span<const std::pair<std::string_view, PlaceLabel>> names_of(PlaceLabel) { return kNames; }

std::string_view name_of(PlaceLabel label) { return kNames[static_cast<std::size_t>(label)].first; }

std::optional<PlaceLabel> place_label(std::string_view name) {
  for (const auto& [known, label] : kNames) {
    if (name == known) {
      return label;
    }
  }
  return name == "trisection" ? std::optional(PlaceLabel::Intersection) : std::nullopt;
}

}  // namespace sketchloc
