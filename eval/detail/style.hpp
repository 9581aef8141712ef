#pragma once

#include <string>
#include <string_view>

namespace sketchloc::detail {

/// Everything up to and including the opening <body> tag; nothing may be loaded from elsewhere.
std::string open_page(std::string_view title);

std::string close_page();

}  // namespace sketchloc::detail
