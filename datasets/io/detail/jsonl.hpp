#pragma once

#include "datasets/io/detail/line_reader.hpp"
#include "datasets/io/run_io.hpp"

namespace sketchloc::detail {

RunFile read_json_lines(LineReader& lines, const RunReading& reading);

}  // namespace sketchloc::detail
