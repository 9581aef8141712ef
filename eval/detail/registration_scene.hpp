#pragma once

#include <string>
#include <vector>

#include "eval/detail/run_picture.hpp"
#include "eval/registration_picture.hpp"

namespace sketchloc::detail {

// What the picture of a registration shows, before it becomes SVG or PNG: one content, two forms.

/// Sizes in units of the picture, of which each form makes pixels: a square with the drawing, the
/// legend below.
struct PictureSizes {
  static constexpr double kSide = 480.0;
  static constexpr double kText = 12.0;  ///< height of letters, from line to line
  static constexpr double kLine = 18.0;  ///< of the legend
  static constexpr double kMargin = 8.0;
};

/// One thing to draw, in units; y up, from the lower left corner of the square.
struct SceneLayer {
  enum class Mark {
    Lines,
    Dots,    ///< at the points of the lines
    Robot,   ///< filled outline of a robot
    Outline  ///< the same, hollow
  };
  Mark mark = Mark::Lines;
  PathLayer look;
};

struct SceneText {
  std::string text;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();  ///< lower left corner, as above
};

struct RegistrationScene {
  View view;                        ///< what the square shows of the drawing
  std::vector<SceneLayer> layers;   ///< from below; finite, and not far outside of the square
  std::vector<SceneLayer> samples;  ///< beside the texts of the legend
  std::vector<SceneText> texts;     ///< of the legend; in the square where nothing was found
  double legend_height = 0.0;
};

RegistrationScene make_registration_scene(const RegistrationView& view);

/// What the square shows of the drawing itself.
PaperExcerpt drawing_of(const RegistrationScene& scene, const Sketch& sketch);

}  // namespace sketchloc::detail
