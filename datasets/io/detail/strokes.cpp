#include "datasets/io/detail/strokes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <span>
#include <vector>

#include "datasets/io/detail/grey.hpp"

namespace sketchloc::detail {
namespace {

using Polarity = SketchReading::Polarity;

constexpr double kWeakInk = 0.3;      ///< share of the usual ink's contrast, kept if connected
constexpr double kStrongInk = 0.5;    ///< share of the usual ink's contrast, kept anyway
constexpr double kDirtShare = 0.003;  ///< of the diagonal
constexpr int kGroundSide_px = 400;   ///< the ground is estimated on a picture of this size

/// Ink of any colour: the darkest channel of dark ink, the lightest of light ink.
cv::Mat1b ink_channel(const cv::Mat& picture, Polarity polarity) {
  if (picture.channels() == 1) {
    return picture;
  }
  std::vector<cv::Mat> channels;
  cv::split(picture, channels);
  cv::Mat out = channels[0];
  for (const cv::Mat& channel : channels) {
    if (polarity == Polarity::DarkOnLight) {
      cv::min(out, channel, out);
    } else {
      cv::max(out, channel, out);
    }
  }
  return out;
}

/// The ground that the strokes are drawn on, at every pixel: follows uneven light.
cv::Mat1b ground_of(const cv::Mat1b& grey) {
  const int side_px = std::max(grey.cols, grey.rows);
  const double shrink = std::min(1.0, kGroundSide_px / static_cast<double>(side_px));
  const cv::Size size(std::max(1, cvRound(grey.cols * shrink)),
                      std::max(1, cvRound(grey.rows * shrink)));
  cv::Mat1b small;
  cv::resize(grey, small, size, 0, 0, cv::INTER_AREA);
  const int window = std::max(3, std::max(size.width, size.height) / 8) | 1;
  cv::Mat1b ground;
  cv::medianBlur(small, ground, window);
  cv::resize(ground, ground, grey.size(), 0, 0, cv::INTER_LINEAR);
  return ground;
}

/// How far every pixel stands out from the ground in the direction of the ink; 0 if not at all.
cv::Mat1b ink_contrast(const cv::Mat1b& grey, Polarity polarity) {
  const cv::Mat1b ground = ground_of(grey);
  cv::Mat1b contrast;
  if (polarity == Polarity::DarkOnLight) {
    cv::subtract(ground, grey, contrast);
  } else {
    cv::subtract(grey, ground, contrast);
  }
  return contrast;
}

Polarity stroke_polarity(const cv::Mat1b& grey) {
  const double dark = cv::norm(ink_contrast(grey, Polarity::DarkOnLight), cv::NORM_L2SQR);
  const double light = cv::norm(ink_contrast(grey, Polarity::LightOnDark), cv::NORM_L2SQR);
  return light > dark ? Polarity::LightOnDark : Polarity::DarkOnLight;
}

/// The level that 3 of 4 pixels stay below, among those from kLeastContrast on; 0 if there are
/// none.
int usual_contrast(const cv::Mat1b& contrast) {
  const Histogram counts = histogram(contrast);
  const auto visible = std::span(counts).subspan(kLeastContrast);
  const std::int64_t total = std::accumulate(visible.begin(), visible.end(), std::int64_t{0});
  std::int64_t below = 0;
  for (std::size_t i = 0; i < visible.size() && total > 0; ++i) {
    below += visible[i];
    if (4 * below >= 3 * total) {
      return kLeastContrast + static_cast<int>(i);
    }
  }
  return 0;
}

/// Keeps the blobs that have strong ink in them and are not dirt.
cv::Mat1b keep_strokes(const cv::Mat1b& weak, const cv::Mat1b& strong, double dirt_px) {
  cv::Mat1i labels;
  cv::Mat1i stats;
  cv::Mat1d centroids;
  const int count = cv::connectedComponentsWithStats(weak, labels, stats, centroids, 8, CV_32S);
  std::vector<unsigned char> keep(static_cast<std::size_t>(count), 0);
  for (int row = 0; row < labels.rows; ++row) {
    for (int column = 0; column < labels.cols; ++column) {
      if (strong(row, column) != 0) {
        keep[static_cast<std::size_t>(labels(row, column))] = 255;
      }
    }
  }
  for (int blob = 1; blob < count; ++blob) {
    if (stats(blob, cv::CC_STAT_WIDTH) < dirt_px && stats(blob, cv::CC_STAT_HEIGHT) < dirt_px) {
      keep[static_cast<std::size_t>(blob)] = 0;
    }
  }
  keep[0] = 0;
  cv::Mat1b out(weak.size());
  for (int row = 0; row < labels.rows; ++row) {
    for (int column = 0; column < labels.cols; ++column) {
      out(row, column) = keep[static_cast<std::size_t>(labels(row, column))];
    }
  }
  return out;
}

}  // namespace

cv::Mat1b find_strokes(const cv::Mat& picture, const SketchReading& reading) {
  const Polarity polarity =
      reading.polarity ? *reading.polarity : stroke_polarity(luminance(picture));
  const cv::Mat1b contrast = ink_contrast(ink_channel(picture, polarity), polarity);
  const int usual_ink = usual_contrast(contrast);
  if (usual_ink == 0) {
    return {};
  }
  const double dirt_px =
      reading.dirt_px.value_or(std::max(3.0, kDirtShare * std::hypot(picture.cols, picture.rows)));
  const double weak = std::max(kWeakInk * usual_ink, kLeastContrast / 2.0);
  return keep_strokes(above(contrast, weak), above(contrast, kStrongInk * usual_ink), dirt_px);
}

}  // namespace sketchloc::detail
