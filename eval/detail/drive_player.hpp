#pragma once

#include <string>
#include <string_view>

namespace sketchloc::detail {

/// A part of a page that plays a drive back: hidden until its script runs. `drive_json` is what
/// drive_html() writes; its strings hold no markup.
std::string drive_player(std::string_view drive_json, std::string_view drawing_png,
                         std::string_view world_png);

}  // namespace sketchloc::detail
