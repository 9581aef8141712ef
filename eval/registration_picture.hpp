#pragma once

#include <optional>
#include <span>
#include <string>

#include "datasets/sketch.hpp"
#include "motion/sim2.hpp"
#include "registration/local_window.hpp"
#include "registration/scan_raster.hpp"
#include "registration/warp_predictor.hpp"

namespace sketchloc {

/// One registration as pictures show it. What the pointers name must outlive it.
struct RegistrationView {
  const Sketch* sketch = nullptr;        ///< not null
  std::span<const PlacedScan> submap{};  ///< drawn as far as they lie in the window
  Sim2 prior_sketch_from_robot{};
  const Registration* registration = nullptr;  ///< null: nothing was found
  std::optional<Sim2> true_sketch_from_robot = std::nullopt;
  LocalWindow window{};  ///< that was looked at
};

/// The scans on the drawing, placed by the prior and bent by the warp, with squares of the robot's
/// plane bent alike, as the figures of [Chen20]; the robot at prior, estimate and reference; a
/// legend. An <svg> element of less than 60 kB that stands alone: nothing loaded, no style needed,
/// no ids, so that a page may hold many.
std::string registration_svg(const RegistrationView& view);

/// The same as the bytes of a PNG file.
std::string registration_png(const RegistrationView& view);

}  // namespace sketchloc
