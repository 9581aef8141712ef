#include "eval/detail/svg.hpp"

#include "eval/detail/text.hpp"

namespace sketchloc::detail {
namespace {

std::string point_text(const Eigen::Vector2d& point) {
  return svg_number(point.x()) + " " + svg_number(point.y());
}

}  // namespace

std::string svg_number(double value) {
  std::string text = fixed(value, 1);
  return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

std::string path_data(std::span<const Polyline> lines, const SketchToSvg& to_svg) {
  std::string data;
  for (const Polyline& line : lines) {
    char command = 'M';
    for (const Eigen::Vector2d& point : line) {
      data += command + point_text(to_svg(point));
      command = 'L';
    }
  }
  return data;
}

std::string dot_data(std::span<const Eigen::Vector2d> points, const SketchToSvg& to_svg) {
  std::string data;
  for (const Eigen::Vector2d& point : points) {
    data += "M" + point_text(to_svg(point)) + "h0";
  }
  return data;
}

std::string stroke(const std::string& data, const Colour& colour, double width,
                   const std::string& more_attributes) {
  if (data.empty()) {
    return {};
  }
  return "<path class=\"stroke\" d=\"" + data + "\" stroke=\"" + hex(colour) +
         "\" stroke-width=\"" + svg_number(width) + "\"" + more_attributes + "/>";
}

std::string open_view(const View& view, const SketchToSvg& to_svg, const std::string& label) {
  const Eigen::Vector2d top_left = to_svg({view.low.x(), view.high.y()});
  return "<svg role=\"img\" aria-label=\"" + escaped(label) + "\" viewBox=\"" +
         point_text(top_left) + " " + svg_number(view.width()) + " " + svg_number(view.height()) +
         "\"><use href=\"#drawing\"/>";
}

}  // namespace sketchloc::detail
