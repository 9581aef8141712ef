#pragma once

#include <string>
#include <string_view>

namespace sketchloc::detail {

/// Whether a page may run the scripts that are in it.
enum class Scripts { None, OwnAlone };

/// Everything up to and including the opening <body> tag; nothing may be loaded from elsewhere.
std::string open_page(std::string_view title, Scripts scripts = Scripts::None);

std::string close_page();

}  // namespace sketchloc::detail
