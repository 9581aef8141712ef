#pragma once

#include <string>
#include <string_view>

namespace sketchloc {

std::string_view version();  ///< such as "0.1.0"
std::string_view commit();   ///< short git commit, with "-dirty" after local changes, or "unknown"
std::string version_text();  ///< "sketchloc 0.1.0 (commit 1234abcd)"

}  // namespace sketchloc
