#include "motion/validate.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace sketchloc {
namespace {

[[noreturn]] void out_of_range(std::string_view field, double value, const std::string& allowed) {
  std::ostringstream message;
  message << field << " must be " << allowed << ", but it is " << value;
  throw std::invalid_argument(message.str());
}

std::string text(double number) {
  std::ostringstream out;
  out << number;
  return out.str();
}

}  // namespace

void require_in_range(std::string_view field, double value, double low, double high) {
  if (!(value >= low && value <= high)) {
    out_of_range(field, value, "in [" + text(low) + ", " + text(high) + "]");
  }
}

void require_at_least(std::string_view field, double value, double low) {
  if (!(value >= low) || std::isinf(value)) {
    out_of_range(field, value, "finite and at least " + text(low));
  }
}

void require_above(std::string_view field, double value, double low) {
  if (!(value > low) || std::isinf(value)) {
    out_of_range(field, value, "finite and above " + text(low));
  }
}

}  // namespace sketchloc
