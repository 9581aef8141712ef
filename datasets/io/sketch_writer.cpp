#include "datasets/io/sketch_writer.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "datasets/io/atomic_file.hpp"
#include "datasets/io/image_rows.hpp"
#include "motion/check.hpp"

namespace sketchloc {
namespace {

constexpr std::uint8_t kPaper = 255;
constexpr std::uint8_t kInk = 0;
constexpr std::uint8_t kFaintInk = 120;
constexpr int kWide_px = 1200;  ///< pictures are enlarged up to about this side

cv::Mat1b image_of(const Sketch& sketch, std::uint8_t ink) {
  cv::Mat1b image = image_from_grid(sketch.occupied);
  std::ranges::transform(image, image.begin(),
                         [ink](std::uint8_t cell) { return cell != 0 ? ink : kPaper; });
  return image;
}

void write_png(const std::filesystem::path& png, const cv::Mat& image) {
  std::vector<std::uint8_t> bytes;
  check(cv::imencode(".png", image, bytes), "a picture can be encoded as PNG");
  write_atomically(png, std::string(bytes.begin(), bytes.end()));
}

constexpr int kShift = 4;  ///< fractional bits of the positions that OpenCV draws at

/// OpenCV puts whole numbers at the centres of pixels, a sketch at their corners.
cv::Point image_point(const Eigen::Vector2d& point_in_sketch, int height_px, double zoom) {
  const double x = zoom * point_in_sketch.x() - 0.5;
  const double y = zoom * (height_px - point_in_sketch.y()) - 0.5;
  return {cvRound(std::ldexp(x, kShift)), cvRound(std::ldexp(y, kShift))};
}

}  // namespace

void write_sketch(const std::filesystem::path& png, const Sketch& sketch) {
  check(!sketch.occupied.empty(), "a drawing has pixels");
  write_png(png, image_of(sketch, kInk));
}

void write_path_picture(const std::filesystem::path& png, const Sketch& sketch,
                        std::span<const Eigen::Vector2d> path_in_sketch) {
  check(!sketch.occupied.empty(), "a drawing has pixels");
  const cv::Scalar blue(190, 100, 0);
  const int zoom = std::clamp(kWide_px / std::max(sketch.width_px(), sketch.height_px()), 1, 4);
  cv::Mat image;
  cv::resize(image_of(sketch, kFaintInk), image, {}, zoom, zoom, cv::INTER_NEAREST);
  cv::cvtColor(image, image, cv::COLOR_GRAY2BGR);
  std::vector<cv::Point> path;
  for (const Eigen::Vector2d& point : path_in_sketch) {
    path.push_back(image_point(point, sketch.height_px(), zoom));
  }
  if (!path.empty()) {
    cv::polylines(image, path, false, blue, 2, cv::LINE_AA, kShift);
    cv::circle(image, path.front(), 7 << kShift, blue, 2, cv::LINE_AA, kShift);
    cv::circle(image, path.back(), 6 << kShift, blue, cv::FILLED, cv::LINE_AA, kShift);
  }
  write_png(png, image);
}

}  // namespace sketchloc
