#include "apps/start_pose.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "motion/angles.hpp"
#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

[[noreturn]] void fail(std::string_view text, const std::string& what) {
  throw std::invalid_argument(
      "--start must be X,Y,HEADING_DEG or X,Y,HEADING_DEG,PX_PER_M, but in '" + std::string(text) +
      "' " + what);
}

std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  for (std::string_view rest = text;;) {
    const std::string_view word = rest.substr(0, rest.find(','));
    const std::optional<double> number = parse_number<double>(word);
    if (!number || !std::isfinite(*number)) {
      fail(text, "'" + std::string(word) + "' is no number");
    }
    numbers.push_back(*number);
    if (word.size() == rest.size()) {
      return numbers;
    }
    rest.remove_prefix(word.size() + 1);
  }
}

}  // namespace

StartPose parse_start_pose(std::string_view text) {
  const std::vector<double> numbers = numbers_in(text);
  if (numbers.size() != 3 && numbers.size() != 4) {
    fail(text, "are " + std::to_string(numbers.size()) + " numbers");
  }
  StartPose start{.place_in_sketch = {numbers[0], numbers[1]},
                  .heading_rad = rad_from_deg(numbers[2]),
                  .px_per_m = std::nullopt};
  if (numbers.size() == 4) {
    if (numbers[3] <= 0.0) {
      fail(text, "PX_PER_M is not above 0");
    }
    start.px_per_m = numbers[3];
  }
  return start;
}

}  // namespace sketchloc
