#include "datasets/io/detail/painted_area.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "datasets/io/detail/grey.hpp"

namespace sketchloc::detail {
namespace {

using Polarity = SketchReading::Polarity;

constexpr double kCommonShare = 0.002;  ///< of all pixels, to count as a level of the picture
constexpr double kThickShare = 0.015;   ///< of the area's diagonal: least half width of a room
constexpr double kLightRest = 0.2;      ///< share of a light area that is at least that thick
constexpr double kDarkRest = 0.5;       ///< the same of a dark one, which may be thick strokes
constexpr double kSharpShare = 0.6;     ///< of an area's outline that is a sharp edge

/// The median level of the outermost pixels.
int border_level(const cv::Mat1b& grey) {
  std::vector<unsigned char> levels;
  for (int column = 0; column < grey.cols; ++column) {
    levels.push_back(grey(0, column));
    levels.push_back(grey(grey.rows - 1, column));
  }
  for (int row = 0; row < grey.rows; ++row) {
    levels.push_back(grey(row, 0));
    levels.push_back(grey(row, grey.cols - 1));
  }
  const auto middle = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2);
  std::ranges::nth_element(levels, middle);
  return *middle;
}

/// The lightest level from `from` downwards that is common in the picture; 0 if none is. A level
/// is common together with its neighbours, since noise and JPEG spread it.
int lightest_common_level(const Histogram& counts, int from, std::size_t pixels) {
  const double enough = std::max(1.0, kCommonShare * static_cast<double>(pixels));
  for (int level = std::min(from, 255); level > 0; --level) {
    int near = 0;
    for (int i = std::max(level - 2, 0); i <= std::min({level + 2, from, 255}); ++i) {
      near += counts[static_cast<std::size_t>(i)];
    }
    if (near >= enough) {
      return level;
    }
  }
  return 0;
}

/// The picture with the painted area as its lightest part.
cv::Mat1b lightness_of(const PaintedArea& area, const cv::Mat1b& grey) {
  return area.light ? grey : inverted(grey);
}

/// Pixels that are clearly lighter than the border; empty if the picture has none.
cv::Mat1b lighter_than_border(const cv::Mat1b& lightness) {
  const int ground = border_level(lightness);
  const int area = lightest_common_level(histogram(lightness), 255, lightness.total());
  return area - ground < kLeastContrast ? cv::Mat1b() : above(lightness, (area + ground) / 2);
}

bool is_thick(const cv::Mat1b& mask, double least_share) {
  const cv::Rect box = cv::boundingRect(mask);
  const double thick_px = std::max(4.0, kThickShare * std::hypot(box.width, box.height));
  return cv::countNonZero(opened(mask, thick_px)) > least_share * cv::countNonZero(mask);
}

/// Is the outline of the area where the grey level jumps, rather than drifts as light on paper?
bool has_sharp_outline(const cv::Mat1b& mask, const cv::Mat1b& lightness) {
  const cv::Mat1b disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(3, 3));
  cv::Mat1b rim;
  cv::morphologyEx(mask, rim, cv::MORPH_GRADIENT, disc);
  cv::Mat1b jump;
  cv::morphologyEx(lightness, jump, cv::MORPH_GRADIENT, disc, cv::Point(-1, -1), 2);
  const double contrast = cv::mean(lightness, mask)[0] - cv::mean(lightness, inverted(mask))[0];
  cv::Mat1b sharp;
  cv::bitwise_and(rim, above(jump, 0.5 * contrast), sharp);
  return cv::countNonZero(sharp) > kSharpShare * cv::countNonZero(rim);
}

bool is_painted(const PaintedArea& area, const cv::Mat1b& grey) {
  const cv::Mat1b lightness = lightness_of(area, grey);
  const cv::Mat1b mask = lighter_than_border(lightness);
  return !mask.empty() && is_thick(mask, area.light ? kLightRest : kDarkRest) &&
         has_sharp_outline(mask, lightness);
}

}  // namespace

std::optional<PaintedArea> find_painted_area(const cv::Mat1b& grey,
                                             const std::optional<Polarity>& polarity) {
  for (const PaintedArea& area : {PaintedArea{.light = true}, PaintedArea{.light = false}}) {
    const bool wanted = !polarity || (*polarity == Polarity::LightOnDark) == area.light;
    if (wanted && is_painted(area, grey)) {
      return area;
    }
  }
  return std::nullopt;
}

PaintedArea other_than_border(const cv::Mat1b& grey) {
  const int ground = border_level(grey);
  const int lightest = lightest_common_level(histogram(grey), 255, grey.total());
  const int darkest = 255 - lightest_common_level(histogram(inverted(grey)), 255, grey.total());
  return {.light = lightest - ground >= ground - darkest};
}

cv::Mat1b obstacles_around(const PaintedArea& area, const cv::Mat1b& grey) {
  const cv::Mat1b lightness = lightness_of(area, grey);
  const Histogram counts = histogram(lightness);
  const int free_level = lightest_common_level(counts, 255, grey.total());
  const int next_level = lightest_common_level(counts, free_level - kLeastContrast, grey.total());
  return inverted(above(lightness, (free_level + next_level) / 2));
}

}  // namespace sketchloc::detail
