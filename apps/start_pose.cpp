#include "apps/start_pose.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "eval/localization.hpp"
#include "motion/angles.hpp"
#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

[[noreturn]] void fail(const std::string& flag, std::string_view text, const std::string& what) {
  throw std::invalid_argument(flag +
                              " must be X,Y,HEADING_DEG or X,Y,HEADING_DEG,PX_PER_M, but in '" +
                              std::string(text) + "' " + what);
}

std::vector<double> numbers_in(std::string_view text, const std::string& flag) {
  std::vector<double> numbers;
  for (std::string_view rest = text;;) {
    const std::string_view word = rest.substr(0, rest.find(','));
    const std::optional<double> number = parse_number<double>(word);
    if (!number || !std::isfinite(*number)) {
      fail(flag, text, "'" + std::string(word) + "' is no number");
    }
    numbers.push_back(*number);
    if (word.size() == rest.size()) {
      return numbers;
    }
    rest.remove_prefix(word.size() + 1);
  }
}

/// The scale that was typed must make a building of the drawing.
void check_scale(const std::string& given, const NamedSketch& drawing, double px_per_m) {
  constexpr double kSmallest_m = 1.0;
  constexpr double kLargest_m = 10'000.0;
  const Sketch& sketch = drawing.sketch;
  const double side_m = std::max(sketch.width_px(), sketch.height_px()) / px_per_m;
  if (side_m < kSmallest_m || side_m > kLargest_m) {
    throw std::invalid_argument(given + ": with that PX_PER_M the longer side of " +
                                drawing.file.string() + " is " + number_text(side_m) +
                                " m; it must be from 1 m to 10000 m");
  }
}

void check_place(const std::string& given, const NamedSketch& drawing,
                 const Eigen::Vector2d& place_in_sketch) {
  const Sketch& sketch = drawing.sketch;
  const Eigen::Array2d size_px(sketch.width_px(), sketch.height_px());
  if ((place_in_sketch.array() < 0.0).any() || (place_in_sketch.array() > size_px).any()) {
    throw std::invalid_argument(given + ": the place is outside " + drawing.file.string() +
                                ", which is " + std::to_string(sketch.width_px()) +
                                " px wide and " + std::to_string(sketch.height_px()) + " px high");
  }
}

}  // namespace

StartPose parse_start_pose(std::string_view text, const std::string& flag) {
  const std::vector<double> numbers = numbers_in(text, flag);
  if (numbers.size() != 3 && numbers.size() != 4) {
    fail(flag, text, "are " + std::to_string(numbers.size()) + " numbers");
  }
  StartPose start{.place_in_sketch = {numbers[0], numbers[1]},
                  .heading_rad = rad_from_deg(numbers[2]),
                  .px_per_m = std::nullopt};
  if (numbers.size() == 4) {
    if (numbers[3] <= 0.0) {
      fail(flag, text, "PX_PER_M is not above 0");
    }
    start.px_per_m = numbers[3];
  }
  return start;
}

StartPose start_pose_in(std::string_view text, const std::string& flag,
                        const NamedSketch& drawing) {
  const StartPose start = parse_start_pose(text, flag);
  const std::string given = flag + " " + std::string(text);
  check_place(given, drawing, start.place_in_sketch);
  if (start.px_per_m) {
    check_scale(given, drawing, *start.px_per_m);
  }
  return start;
}

std::optional<Sim2> pose_at(const StartPose& start, const std::string& flag, const Sketch& sketch,
                            const Scan& scan) {
  std::optional<double> px_per_m = start.px_per_m ? start.px_per_m : sketch.px_per_m;
  if (!px_per_m) {
    px_per_m = guess_px_per_m(sketch, start.place_in_sketch, start.heading_rad, scan);
    if (!px_per_m) {
      return std::nullopt;
    }
    spdlog::info("{}: the scan suggests {:.1f} px/m there", flag, *px_per_m);
  }
  return Sim2::from_xy_yaw_scale(start.place_in_sketch.x(), start.place_in_sketch.y(),
                                 start.heading_rad, *px_per_m);
}

Sim2 pose_in_drawing(std::string_view text, const std::string& flag, const NamedSketch& drawing,
                     const Scan& scan) {
  const StartPose start = start_pose_in(text, flag, drawing);
  const std::optional<Sim2> pose = pose_at(start, flag, drawing.sketch, scan);
  if (!pose) {
    throw std::runtime_error(flag +
                             " without PX_PER_M: the scan does not tell the scale there; give "
                             "PX_PER_M");
  }
  return *pose;
}

}  // namespace sketchloc
