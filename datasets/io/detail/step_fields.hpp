#pragma once

#include <string_view>

#include "datasets/io/detail/json_fields.hpp"
#include "datasets/scan.hpp"
#include "motion/se2.hpp"

namespace sketchloc::detail {

// The parts of a step in JSON, in logs and in messages: docs/formats.md.

Se2 read_json_pose(const JsonFields& fields, std::string_view key);

/// The scan of a step, with the step's time.
Scan read_json_scan(const JsonFields& step);

}  // namespace sketchloc::detail
