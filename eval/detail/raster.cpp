#include "eval/detail/raster.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "datasets/io/image_rows.hpp"
#include "motion/check.hpp"

namespace sketchloc::detail {
namespace {

constexpr double kWhite = 255.0;

/// Averages, then darkens by as much as averaging pales a line of one pixel.
cv::Mat1b reduced(const cv::Mat1b& image, const cv::Size& size) {
  const double factor = static_cast<double>(size.width) / image.cols;
  cv::Mat light;
  cv::resize(image, light, size, 0.0, 0.0, cv::INTER_AREA);
  double darkest = 0.0;
  cv::minMaxLoc(image, &darkest);
  cv::Mat1b dark;
  light.convertTo(dark, CV_8U, 1.0 / factor, kWhite - kWhite / factor);
  cv::max(dark, cv::Scalar(darkest), dark);
  return dark;
}

/// The view in whole pixels with white where it leaves the picture.
cv::Mat1b cut_out(const Grid<std::uint8_t>& grey, const View& view) {
  const cv::Rect whole(0, 0, grey.width(), grey.height());
  const cv::Point low(static_cast<int>(std::floor(view.low.x())),
                      static_cast<int>(std::floor(grey.height() - view.high.y())));
  const cv::Rect wanted(low, cv::Size(std::max(1, static_cast<int>(std::round(view.width()))),
                                      std::max(1, static_cast<int>(std::round(view.height())))));
  cv::Mat1b image(wanted.size(), static_cast<std::uint8_t>(kWhite));
  const cv::Rect there = wanted & whole;
  if (!there.empty()) {
    image_from_grid(grey)(there).copyTo(image(there - low));
  }
  return image;
}

}  // namespace

Grid<std::uint8_t> zoomed(const Grid<std::uint8_t>& grey, const View& view, double zoom) {
  check(zoom > 0.0, "a zoom is positive");
  const cv::Mat1b image = cut_out(grey, view);
  const cv::Size size(std::max(1, cvRound(zoom * view.width())),
                      std::max(1, cvRound(zoom * view.height())));
  if (zoom < 1.0) {
    return grid_from_image(reduced(image, size));
  }
  cv::Mat1b larger;
  cv::resize(image, larger, size, 0.0, 0.0, cv::INTER_LINEAR);
  return grid_from_image(larger);
}

std::string encode_png(const Grid<std::uint8_t>& grey, int longest_px) {
  if (grey.empty()) {
    return {};
  }
  const double zoom = static_cast<double>(longest_px) / std::max(grey.width(), grey.height());
  const View whole{.low = {0.0, 0.0}, .high = {grey.width(), grey.height()}};
  const cv::Mat1b image = image_from_grid(zoom < 1.0 ? zoomed(grey, whole, zoom) : grey);
  std::vector<std::uint8_t> bytes;
  check(cv::imencode(".png", image, bytes, {cv::IMWRITE_PNG_COMPRESSION, 9}),
        "a grey image can be encoded as PNG");
  return {bytes.begin(), bytes.end()};
}

}  // namespace sketchloc::detail
