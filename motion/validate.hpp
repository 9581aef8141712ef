#pragma once

#include <string_view>

namespace sketchloc {

/// The one wording for parameters out of range: throws std::invalid_argument with field, allowed
/// range and value. NaN is never in a range.
void require_in_range(std::string_view field, double value, double low, double high);
void require_at_least(std::string_view field, double value, double low);
void require_above(std::string_view field, double value, double low);

}  // namespace sketchloc
