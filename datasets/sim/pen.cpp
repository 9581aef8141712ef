#include "datasets/sim/detail/pen.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sketchloc::detail {
namespace {

constexpr double kPointSpacing_px = 2.0;

Eigen::Vector2d left_of(const Eigen::Vector2d& direction) {
  return {-direction.y(), direction.x()};
}

/// Moving average over a window of arc length; the ends stay.
Stroke rounded(const Stroke& stroke, double radius_px) {
  const auto reach = static_cast<std::ptrdiff_t>(radius_px / kPointSpacing_px);
  const auto size = static_cast<std::ptrdiff_t>(stroke.size());
  Stroke result = stroke;
  for (std::ptrdiff_t i = 1; i + 1 < size; ++i) {
    const std::ptrdiff_t window = std::min({reach, i, size - 1 - i});
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::ptrdiff_t j = i - window; j <= i + window; ++j) {
      sum += stroke[static_cast<std::size_t>(j)];
    }
    result[static_cast<std::size_t>(i)] = sum / static_cast<double>(2 * window + 1);
  }
  return result;
}

/// Smooth noise along a stroke: random values every `length`, joined by cosines.
class SmoothNoise {
 public:
  SmoothNoise(double sigma, double length, double extent, Rng& rng) : length_(length) {
    for (double at = -length; at < extent + 2.0 * length; at += length) {
      values_.push_back(gaussian(sigma, rng));
    }
  }
  double at(double way) const {
    const double t = way / length_ + 1.0;
    const std::size_t i = std::min(static_cast<std::size_t>(t), values_.size() - 2);
    const double blend = 0.5 - 0.5 * std::cos(std::numbers::pi * (t - static_cast<double>(i)));
    return (1.0 - blend) * values_[i] + blend * values_[i + 1];
  }

 private:
  double length_;
  std::vector<double> values_;
};

Stroke wobbling(const Stroke& stroke, const PenParams& pen, Rng& rng) {
  const double extent_px = kPointSpacing_px * static_cast<double>(stroke.size());
  const SmoothNoise sideways(pen.wobble_px, pen.wobble_length_px, extent_px, rng);
  const SmoothNoise tremor(0.25 * pen.wobble_px, 0.2 * pen.wobble_length_px, extent_px, rng);
  Stroke result = stroke;
  for (std::size_t i = 0; i < stroke.size(); ++i) {
    const Eigen::Vector2d along =
        stroke[std::min(i + 1, stroke.size() - 1)] - stroke[i > 0 ? i - 1 : 0];
    if (along.squaredNorm() > 0.0) {
      const double way_px = kPointSpacing_px * static_cast<double>(i);
      result[i] += (sideways.at(way_px) + tremor.at(way_px)) * left_of(along.normalized());
    }
  }
  return result;
}

/// Cuts off or prolongs the front of a stroke by a length in px.
void shift_front(Stroke& stroke, double length_px) {
  if (length_px >= 0.0) {
    const Eigen::Vector2d outwards = (stroke[0] - stroke[1]).normalized();
    stroke.insert(stroke.begin(), stroke.front() + length_px * outwards);
    return;
  }
  const auto points = static_cast<std::size_t>(-length_px / kPointSpacing_px);
  const std::size_t dropped = std::min(points, stroke.size() / 4);
  stroke.erase(stroke.begin(), stroke.begin() + static_cast<std::ptrdiff_t>(dropped));
}

}  // namespace

Stroke drawn_by_hand(const Stroke& stroke_in_sketch, const PenParams& pen, Rng& rng) {
  Stroke stroke = resample(stroke_in_sketch, kPointSpacing_px);
  stroke = rounded(stroke, pen.rounding_px * uniform(0.3, 1.5, rng));
  stroke = wobbling(stroke, pen, rng);
  for (int end = 0; end < 2; ++end) {
    const double error_px = gaussian(pen.end_error_px, rng);
    if (stroke.size() > 2) {
      shift_front(stroke, error_px);
    }
    std::reverse(stroke.begin(), stroke.end());
  }
  return stroke;
}

}  // namespace sketchloc::detail
