#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sketchloc::testing {

/// What is wrong with the markup of a page, one entry per fault: tags that are not closed in
/// order, attributes without quotes, bare `<` or `&`. A small independent check, stricter than
/// browsers: void elements must close themselves.
std::vector<std::string> markup_faults(std::string_view page);

}  // namespace sketchloc::testing
