#include "eval/registration_picture.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "datasets/io/image_rows.hpp"
#include "eval/detail/canvas.hpp"
#include "eval/detail/raster.hpp"
#include "eval/detail/registration_scene.hpp"
#include "eval/detail/svg.hpp"
#include "eval/detail/text.hpp"

namespace sketchloc {
namespace {

using detail::PaperExcerpt;
using detail::PictureSizes;
using detail::RegistrationScene;
using detail::SceneLayer;
using detail::SceneText;
using detail::svg_number;
using detail::View;
using Mark = SceneLayer::Mark;

bool is_robot(const SceneLayer& layer) {
  return layer.mark == Mark::Robot || layer.mark == Mark::Outline;
}

/// Where an excerpt lies in the square, in units, y down.
cv::Rect2d place_of(const PaperExcerpt& excerpt, const View& view) {
  const double zoom = PictureSizes::kSide / view.width();
  return {zoom * (excerpt.view.low.x() - view.low.x()),
          zoom * (view.high.y() - excerpt.view.high.y()), zoom * excerpt.view.width(),
          zoom * excerpt.view.height()};
}

/// The bytes of a PNG file, coarser where they would be too many.
std::string small_png(const Grid<std::uint8_t>& grey) {
  constexpr std::size_t kMost_bytes = 20'000;
  int longest_px = 640;
  std::string bytes = detail::encode_png(grey, longest_px);
  while (bytes.size() > kMost_bytes) {
    longest_px = longest_px * 3 / 4;
    bytes = detail::encode_png(grey, longest_px);
  }
  return bytes;
}

std::string drawing_svg(const RegistrationScene& scene, const Sketch& sketch) {
  const PaperExcerpt excerpt = drawing_of(scene, sketch);
  if (excerpt.grey.empty()) {
    return {};
  }
  const cv::Rect2d place = place_of(excerpt, scene.view);
  return "<image x=\"" + svg_number(place.x) + "\" y=\"" + svg_number(place.y) + "\" width=\"" +
         svg_number(place.width) + "\" height=\"" + svg_number(place.height) +
         "\" preserveAspectRatio=\"none\" href=\"data:image/png;base64," +
         detail::base64(small_png(excerpt.grey)) + "\"/>";
}

std::string layer_svg(const SceneLayer& layer) {
  const detail::SketchToSvg to_svg{.height_px = PictureSizes::kSide};
  std::string data;
  if (layer.mark == Mark::Dots) {
    for (const detail::Polyline& dots : layer.look.lines) {
      data += detail::dot_data(dots, to_svg);
    }
  } else {
    data = detail::path_data(layer.look.lines, to_svg);
  }
  if (data.empty()) {
    return {};
  }
  const std::string colour = detail::hex(layer.look.colour);
  const std::string closed = is_robot(layer) ? "Z" : "";
  const std::string paint =
      layer.mark == Mark::Robot
          ? "fill=\"" + colour + "\" stroke=\"#fff\""
          : "stroke=\"" + colour + "\" stroke-width=\"" + svg_number(layer.look.width) + "\"";
  return "<path d=\"" + data + closed + "\" " + paint + "/>";
}

std::string text_svg(const SceneText& text) {
  return "<text x=\"" + svg_number(text.at.x()) + "\" y=\"" +
         svg_number(PictureSizes::kSide - text.at.y()) + "\" fill=\"" + detail::hex(detail::kText) +
         "\">" + detail::escaped(text.text) + "</text>";
}

std::string open_svg(const RegistrationScene& scene, const std::string& label) {
  const std::string side = svg_number(PictureSizes::kSide);
  const std::string height = svg_number(PictureSizes::kSide + scene.legend_height);
  return "<svg role=\"img\" aria-label=\"" + label + "\" width=\"" + side + "\" height=\"" +
         height + "\" viewBox=\"0 0 " + side + " " + height +
         "\" font-family=\"system-ui,sans-serif\" font-size=\"" + svg_number(PictureSizes::kText) +
         "\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\">";
}

std::string white_svg(double y, double height) {
  return "<rect y=\"" + svg_number(y) + "\" width=\"" + svg_number(PictureSizes::kSide) +
         "\" height=\"" + svg_number(height) + "\" fill=\"#fff\"/>";
}

constexpr double kPixels = 2.0;  ///< of a PNG file per unit

cv::Mat3b drawing_image(const RegistrationScene& scene, const Sketch& sketch) {
  const int side_px = cvRound(kPixels * PictureSizes::kSide);
  cv::Mat3b image(side_px, side_px, cv::Vec3b(255, 255, 255));
  const PaperExcerpt excerpt = drawing_of(scene, sketch);
  if (excerpt.grey.empty()) {
    return image;
  }
  const View whole{.low = {0.0, 0.0}, .high = {excerpt.grey.width(), excerpt.grey.height()}};
  const cv::Mat1b grey = image_from_grid(
      detail::zoomed(excerpt.grey, whole, kPixels * PictureSizes::kSide / scene.view.width()));
  const cv::Rect2d place = place_of(excerpt, scene.view);
  const cv::Point at(cvRound(kPixels * place.x), cvRound(kPixels * place.y));
  const cv::Rect there = cv::Rect(at, grey.size()) & cv::Rect({}, image.size());
  cv::cvtColor(grey(there - at), image(there), cv::COLOR_GRAY2BGR);
  return image;
}

/// Corners at sub-pixel positions.
void draw_robot(cv::Mat3b& image, const SceneLayer& layer, const std::vector<cv::Point>& corners) {
  const cv::Scalar colour = detail::bgr(layer.look.colour);
  if (layer.mark == Mark::Outline) {
    cv::polylines(image, corners, true, colour, cvRound(kPixels * layer.look.width), cv::LINE_AA,
                  detail::kShift);
    return;
  }
  cv::fillPoly(image, std::vector{corners}, colour, cv::LINE_AA, detail::kShift);
  cv::polylines(image, corners, true, {255, 255, 255}, cvRound(kPixels), cv::LINE_AA,
                detail::kShift);
}

void draw_dots(cv::Mat3b& image, const SceneLayer& layer, const std::vector<cv::Point>& dots) {
  const int radius = cvRound(std::ldexp(0.5 * kPixels * layer.look.width, detail::kShift));
  for (const cv::Point& dot : dots) {
    cv::circle(image, dot, radius, detail::bgr(layer.look.colour), cv::FILLED, cv::LINE_AA,
               detail::kShift);
  }
}

void draw_layer(cv::Mat3b& image, const SceneLayer& layer, const detail::Frame& frame) {
  if (layer.mark == Mark::Lines) {
    detail::draw_layer(image, layer.look, frame, kPixels);
    return;
  }
  for (const detail::Polyline& line : layer.look.lines) {
    std::vector<cv::Point> points;
    for (const Eigen::Vector2d& point : line) {
      points.push_back(detail::sub_pixel(frame.at(point)));
    }
    if (is_robot(layer)) {
      draw_robot(image, layer, points);
    } else {
      draw_dots(image, layer, points);
    }
  }
}

}  // namespace

std::string registration_svg(const RegistrationView& view) {
  const RegistrationScene scene = detail::make_registration_scene(view);
  std::string svg = open_svg(scene, "A scan on a drawing, as a registration places and bends it") +
                    white_svg(0.0, PictureSizes::kSide) + drawing_svg(scene, *view.sketch);
  for (const SceneLayer& layer : scene.layers) {
    svg += layer_svg(layer);
  }
  svg += white_svg(PictureSizes::kSide, scene.legend_height);  // over what leaves the square
  for (const SceneLayer& sample : scene.samples) {
    svg += layer_svg(sample);
  }
  for (const SceneText& text : scene.texts) {
    svg += text_svg(text);
  }
  return svg + "</svg>";
}

std::string registration_png(const RegistrationView& view) {
  constexpr double kTextSize = 0.52;
  const RegistrationScene scene = detail::make_registration_scene(view);
  const detail::Frame frame{
      .view = {.low = {0.0, 0.0}, .high = Eigen::Vector2d::Constant(PictureSizes::kSide)},
      .zoom = kPixels};
  cv::Mat3b image = drawing_image(scene, *view.sketch);
  for (const SceneLayer& layer : scene.layers) {
    draw_layer(image, layer, frame);
  }
  image.push_back(
      cv::Mat3b(cvRound(kPixels * scene.legend_height), image.cols, cv::Vec3b(255, 255, 255)));
  for (const SceneLayer& sample : scene.samples) {
    draw_layer(image, sample, frame);
  }
  for (const SceneText& text : scene.texts) {
    detail::write_text(image, text.text, frame.at(text.at), kTextSize);
  }
  return detail::png_bytes(image);
}

}  // namespace sketchloc
