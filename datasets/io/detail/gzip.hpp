#pragma once

#include <string>
#include <string_view>

namespace sketchloc::detail {

/// The bytes of a gzip file with that content; the same content gives the same bytes.
std::string gzipped(std::string_view content);

}  // namespace sketchloc::detail
