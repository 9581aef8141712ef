#include "motion/validate.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

[[noreturn]] void out_of_range(std::string_view field, double value, const std::string& allowed) {
  throw std::invalid_argument(std::string(field) + " must be " + allowed + ", but it is " +
                              number_text(value));
}

}  // namespace

void require_in_range(std::string_view field, double value, double low, double high) {
  if (!(value >= low && value <= high)) {
    out_of_range(field, value, "in [" + number_text(low) + ", " + number_text(high) + "]");
  }
}

void require_at_least(std::string_view field, double value, double low) {
  if (!(value >= low) || std::isinf(value)) {
    out_of_range(field, value, "finite and at least " + number_text(low));
  }
}

void require_above(std::string_view field, double value, double low) {
  if (!(value > low) || std::isinf(value)) {
    out_of_range(field, value, "finite and above " + number_text(low));
  }
}

}  // namespace sketchloc
