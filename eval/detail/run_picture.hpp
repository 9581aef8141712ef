#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "eval/run_record.hpp"

namespace sketchloc::detail {

/// What the first picture of a run shows, before it becomes SVG or PNG: one content, two forms.
/// All points in the sketch frame.

struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
};

// Distinct also without colour vision. [Okabe08]
constexpr Colour kGood{0, 158, 115};
constexpr Colour kFair{230, 159, 0};
constexpr Colour kBad{213, 68, 0};
constexpr Colour kReferenceBlue{0, 100, 190};
constexpr Colour kGrey{110, 110, 118};

/// "#00a1ff", as SVG and CSS want it.
std::string hex(const Colour& colour);

using Polyline = std::vector<Eigen::Vector2d>;

/// Lines of one look.
struct PathLayer {
  std::string name;  ///< for the legend; empty: explained by the text
  Colour colour;
  double width = 2.0;  ///< relative to other layers, in screen pixels where there is a screen
  bool dashed = false;
  std::vector<Polyline> lines = {};
};

/// Rectangle of the drawing that a picture shows.
struct View {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  Eigen::Vector2d high = Eigen::Vector2d::Ones();

  double width() const { return high.x() - low.x(); }
  double height() const { return high.y() - low.y(); }
};

/// All strokes and paths with a margin; of paths that leave the drawing no more than half of its
/// size beyond its edges.
View whole_view(const RunRecord& record, std::span<const PathLayer> layers);

/// Reference first, estimate on top. The estimate is coloured by its error where there is a
/// reference, else by time.
std::vector<PathLayer> path_layers(const RunRecord& record, std::span<const StepError> errors);

/// Grey values of the drawing as it lies under the paths: white paper, grey ink.
Grid<std::uint8_t> paper(const Sketch& sketch, std::uint8_t ink = 150);

/// A part of a drawing in whole pixels.
struct PaperExcerpt {
  Grid<std::uint8_t> grey;  ///< as of paper(); empty where the view shows nothing of the drawing
  View view;                ///< what it shows
};

/// What a view shows of the drawing itself: nothing of what lies beyond its edges.
PaperExcerpt paper_excerpt(const Sketch& sketch, const View& view, std::uint8_t ink);

}  // namespace sketchloc::detail
