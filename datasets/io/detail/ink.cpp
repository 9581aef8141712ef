#include "datasets/io/detail/ink.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace sketchloc::detail {
namespace {

using Polarity = SketchReading::Polarity;

constexpr int kLeastContrast = 24;     ///< grey levels between ink and ground
constexpr double kThickShare = 0.015;  ///< of the diagonal: half the width of a painted area
constexpr double kStrokeRest = 0.2;    ///< strokes lose at least the rest when opened that far
constexpr double kSharpShare = 0.6;    ///< of a painted area's outline that is a sharp edge
constexpr double kWeakInk = 0.3;       ///< share of the usual ink's contrast, kept if connected
constexpr double kStrongInk = 0.5;     ///< share of the usual ink's contrast, kept anyway
constexpr double kDirtShare = 0.003;   ///< of the diagonal
constexpr int kGroundSide_px = 400;    ///< the ground is estimated on a picture of this size

double diagonal_px(const cv::Mat& picture) { return std::hypot(picture.cols, picture.rows); }

cv::Mat1b disc(int radius_px) {
  return cv::getStructuringElement(cv::MORPH_ELLIPSE,
                                   cv::Size(2 * radius_px + 1, 2 * radius_px + 1));
}

cv::Mat1b luminance(const cv::Mat& picture) {
  if (picture.channels() == 1) {
    return picture;
  }
  cv::Mat1b grey;
  cv::cvtColor(picture, grey, cv::COLOR_BGR2GRAY);
  return grey;
}

cv::Mat1b above(const cv::Mat1b& values, double limit) {
  cv::Mat1b mask;
  cv::compare(values, limit, mask, cv::CMP_GT);
  return mask;
}

cv::Mat1b inverted(const cv::Mat1b& values) {
  cv::Mat1b out;
  cv::bitwise_not(values, out);
  return out;
}

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

/// Puts a transparent drawing on paper of the other lightness than its ink.
cv::Mat without_alpha(const cv::Mat& picture, std::optional<Polarity> polarity) {
  if (picture.channels() != 4) {
    return picture;
  }
  cv::Mat3b out;
  cv::cvtColor(picture, out, cv::COLOR_BGRA2BGR);
  cv::Mat1b alpha;
  cv::extractChannel(picture, alpha, 3);
  const bool light_ink = polarity ? *polarity == Polarity::LightOnDark
                                  : cv::mean(luminance(out), above(alpha, 127))[0] > 127.0;
  const int ground = light_ink ? 0 : 255;
  for (int row = 0; row < out.rows; ++row) {
    for (int column = 0; column < out.cols; ++column) {
      const int opacity = alpha(row, column);
      for (int channel = 0; channel < 3; ++channel) {
        unsigned char& value = out(row, column)[channel];
        value = static_cast<unsigned char>((value * opacity + ground * (255 - opacity)) / 255);
      }
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

/// The level that 3 of 4 pixels stay below, among those from `lowest` on; 0 if there are none.
int upper_quartile(const cv::Mat1b& values, int lowest) {
  std::vector<int> counts(256, 0);
  for (const unsigned char value : values) {
    ++counts[value];
  }
  int total = 0;
  for (int level = lowest; level < 256; ++level) {
    total += counts[static_cast<std::size_t>(level)];
  }
  int below = 0;
  for (int level = lowest; level < 256; ++level) {
    below += counts[static_cast<std::size_t>(level)];
    if (4 * static_cast<long long>(below) >= 3 * static_cast<long long>(total) && total > 0) {
      return level;
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

cv::Mat1b find_strokes(const cv::Mat& picture, const SketchReading& reading) {
  const Polarity polarity =
      reading.polarity ? *reading.polarity : stroke_polarity(luminance(picture));
  const cv::Mat1b contrast = ink_contrast(ink_channel(picture, polarity), polarity);
  const double usual_ink = upper_quartile(contrast, kLeastContrast);
  if (usual_ink == 0.0) {
    return {};
  }
  const double dirt_px = reading.dirt_px.value_or(std::max(3.0, kDirtShare * diagonal_px(picture)));
  return keep_strokes(above(contrast, kWeakInk * usual_ink),
                      above(contrast, kStrongInk * usual_ink), dirt_px);
}

/// The painted class of a picture in two classes: the one that is not the ground, which is the one
/// that the border of the picture has more of.
struct Painted {
  cv::Mat1b mask;
  bool light = false;
};

Painted painted_class(const cv::Mat1b& grey, std::optional<Polarity> polarity) {
  cv::Mat1b light_mask;
  cv::threshold(grey, light_mask, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU);
  const int light_border =
      cv::countNonZero(light_mask.row(0)) + cv::countNonZero(light_mask.row(grey.rows - 1)) +
      cv::countNonZero(light_mask.col(0)) + cv::countNonZero(light_mask.col(grey.cols - 1));
  const bool light =
      polarity ? *polarity == Polarity::LightOnDark : light_border <= grey.rows + grey.cols;
  return {.mask = light ? light_mask : inverted(light_mask), .light = light};
}

/// Share of the outline of an area where the grey level jumps, not drifts as light on paper does.
double sharp_share_of_outline(const cv::Mat1b& area, const cv::Mat1b& grey) {
  cv::Mat1b rim;
  cv::morphologyEx(area, rim, cv::MORPH_GRADIENT, disc(1));
  cv::Mat1b jump;
  cv::morphologyEx(grey, jump, cv::MORPH_GRADIENT, disc(2));
  const double contrast = std::abs(cv::mean(grey, area)[0] - cv::mean(grey, inverted(area))[0]);
  cv::Mat1b sharp;
  cv::bitwise_and(rim, above(jump, 0.5 * contrast), sharp);
  const int length = cv::countNonZero(rim);
  return length == 0
             ? 0.0
             : cv::countNonZero(rim & (jump > 0.5 * contrast)) / static_cast<double>(length);
}

Sketch::Kind find_kind(const cv::Mat1b& grey, const Painted& painted) {
  const int thick_px = std::max(4, static_cast<int>(kThickShare * diagonal_px(grey)));
  cv::Mat1b thick;
  cv::morphologyEx(painted.mask, thick, cv::MORPH_OPEN, disc(thick_px));
  const bool is_thick = cv::countNonZero(thick) > kStrokeRest * cv::countNonZero(painted.mask);
  const bool filled = is_thick && sharp_share_of_outline(painted.mask, grey) > kSharpShare;
  return filled ? Sketch::Kind::FilledFreeSpace : Sketch::Kind::Strokes;
}

/// Everything that is not as light (or dark) as the painted area.
cv::Mat1b find_obstacles(const cv::Mat1b& grey, const Painted& painted) {
  std::vector<int> counts(256, 0);
  for (const unsigned char level : grey) {
    ++counts[painted.light ? level : 255 - level];
  }
  const cv::Mat1b lightness = painted.light ? grey : inverted(grey);
  // The free level is the lightest mode; the limit lies half way to the next common level below.
  const int enough = std::max(1, static_cast<int>(0.005 * static_cast<double>(grey.total())));
  const auto mode = [&counts, enough](int from) {
    for (int level = from; level >= 0; --level) {
      if (counts[static_cast<std::size_t>(level)] >= enough) {
        return level;
      }
    }
    return 0;
  };
  const int free_level = mode(255);
  const int next_level = mode(free_level - kLeastContrast);
  return inverted(above(lightness, (free_level + next_level) / 2));
}

}  // namespace

Ink find_ink(const cv::Mat& picture, const SketchReading& reading) {
  const cv::Mat opaque = without_alpha(picture, reading.polarity);
  const cv::Mat1b grey = luminance(opaque);
  const Painted painted = painted_class(grey, reading.polarity);
  Ink ink;
  ink.kind = reading.kind ? *reading.kind : find_kind(grey, painted);
  ink.occupied = ink.kind == Sketch::Kind::Strokes ? find_strokes(opaque, reading)
                                                   : find_obstacles(grey, painted);
  if (!ink.occupied.empty() && cv::countNonZero(ink.occupied) == 0) {
    ink.occupied.release();
  }
  return ink;
}

}  // namespace sketchloc::detail
