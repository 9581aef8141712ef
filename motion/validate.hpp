#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace sketchloc {

/// The one wording for parameters out of range: throws std::invalid_argument with field, allowed
/// range and value. NaN is never in a range.
void require_in_range(std::string_view field, double value, double low, double high);
void require_at_least(std::string_view field, double value, double low);
void require_above(std::string_view field, double value, double low);

/// Validates a part of larger parameters; its name goes before the field in the message.
template <typename Params>
void validate_part(std::string_view name, const Params& part) {
  try {
    validate(part);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(std::string(name) + "." + error.what());
  }
}

}  // namespace sketchloc
