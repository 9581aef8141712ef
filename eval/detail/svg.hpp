#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

#include "eval/detail/run_picture.hpp"

namespace sketchloc::detail {

/// Short decimal number of an SVG attribute: "12.3", "4".
std::string svg_number(double value);

/// Maps the sketch (y up) onto the user space of an <svg> that shows the drawing (y down).
struct SketchToSvg {
  double height_px = 0.0;  ///< of the whole drawing

  Eigen::Vector2d operator()(const Eigen::Vector2d& point_in_sketch) const {
    return {point_in_sketch.x(), height_px - point_in_sketch.y()};
  }
};

/// Value of `d` for polylines.
std::string path_data(std::span<const Polyline> lines, const SketchToSvg& to_svg);

/// Value of `d` for round dots: lines of no length, drawn with round caps.
std::string dot_data(std::span<const Eigen::Vector2d> points, const SketchToSvg& to_svg);

/// <path> whose width stays in screen pixels whatever the zoom.
std::string stroke(const std::string& data, const Colour& colour, double width,
                   const std::string& more_attributes = {});

/// Opening <svg> tag for a part of the drawing, and the drawing itself as its first child.
std::string open_view(const View& view, const SketchToSvg& to_svg, const std::string& label);

}  // namespace sketchloc::detail
