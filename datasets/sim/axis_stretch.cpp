#include "datasets/sim/axis_stretch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "motion/check.hpp"

namespace sketchloc {
namespace {

/// The three quadratic B-splines that are not zero at t (in units of their spacing).
struct Blend {
  int first;  ///< index of the lowest one
  std::array<double, 3> weight;
  std::array<double, 3> slope;
};

Blend blend_at(double t) {
  const double nearest = std::round(t);
  const double d = t - nearest;  // in [-0.5, 0.5]
  return {.first = static_cast<int>(nearest) - 1,
          .weight = {0.5 * (0.5 - d) * (0.5 - d), 0.75 - d * d, 0.5 * (0.5 + d) * (0.5 + d)},
          .slope = {d - 0.5, -2.0 * d, d + 0.5}};
}

}  // namespace

AxisStretch::AxisStretch(const Lattice& lattice, Grid<double> rates, std::vector<double> starts)
    : lattice_(lattice), rates_(std::move(rates)), positions_(rates_.width(), rates_.height()) {
  check(lattice.along > 0.0 && lattice.across > 0.0, "a lattice has spacings");
  check(rates_.width() >= 2 && rates_.height() >= 1, "a stretch has 2 columns and a row");
  check(starts.size() == static_cast<std::size_t>(rates_.height()), "one start per row");
  for (int row = 0; row < rates_.height(); ++row) {
    double position = starts[static_cast<std::size_t>(row)];
    for (int column = 0; column < rates_.width(); ++column) {
      check(rates_.at({column, row}) > 0.0, "rates are positive");
      if (column > 0) {
        const double mean_rate = 0.5 * (rates_.at({column - 1, row}) + rates_.at({column, row}));
        position += lattice.along * mean_rate;
      }
      positions_.at({column, row}) = position;
    }
  }
}

AxisStretch::OnRow AxisStretch::on_row(int row, double u) const {
  const double t = (u - lattice_.low.x()) / lattice_.along;
  const int last = rates_.width() - 1;
  if (t <= 0.0) {
    const double rate = rates_.at({0, row});
    return {positions_.at({0, row}) + lattice_.along * t * rate, rate};
  }
  if (t >= last) {
    const double rate = rates_.at({last, row});
    return {positions_.at({last, row}) + lattice_.along * (t - last) * rate, rate};
  }
  const int column = std::min(static_cast<int>(t), last - 1);
  const double f = t - column;
  const double here = rates_.at({column, row});
  const double change = rates_.at({column + 1, row}) - here;
  return {positions_.at({column, row}) + lattice_.along * f * (here + 0.5 * f * change),
          here + f * change};
}

AxisStretch::Moved AxisStretch::moved(double u, double v) const {
  const Blend blend = blend_at((v - lattice_.low.y()) / lattice_.across);
  Moved sum{0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const int row = std::clamp(blend.first + static_cast<int>(i), 0, rates_.height() - 1);
    const OnRow here = on_row(row, u);
    sum.position += blend.weight[i] * here.position;
    sum.rate += blend.weight[i] * here.rate;
    sum.shear += blend.slope[i] * here.position / lattice_.across;
  }
  return sum;
}

PlaneMapPoint AxisStretch::at(const Eigen::Vector2d& point) const {
  const int along = lattice_.axis;
  const int across = 1 - along;
  const Moved here = moved(point(along), point(across));
  PlaneMapPoint result{.value = point, .jacobian = Eigen::Matrix2d::Identity()};
  result.value(along) = here.position;
  result.jacobian(along, along) = here.rate;
  result.jacobian(along, across) = here.shear;
  return result;
}

Eigen::Vector2d AxisStretch::inverse(const Eigen::Vector2d& image) const {
  const int along = lattice_.axis;
  const double v = image(1 - along);
  const double target = image(along);
  double low = lattice_.low.x();
  double high = low + lattice_.along * (rates_.width() - 1);
  for (double step = high - low; moved(low, v).position > target; step *= 2.0) {
    low -= step;
  }
  for (double step = high - low; moved(high, v).position < target; step *= 2.0) {
    high += step;
  }
  double u = 0.5 * (low + high);
  for (int iteration = 0; iteration < 100 && high - low > 1e-13 * (1.0 + std::abs(u));
       ++iteration) {
    const Moved here = moved(u, v);
    if (here.position == target) {
      break;
    }
    (here.position < target ? low : high) = u;
    const double newton = u + (target - here.position) / here.rate;
    u = newton > low && newton < high ? newton : 0.5 * (low + high);
  }
  Eigen::Vector2d point = image;
  point(along) = u;
  return point;
}

}  // namespace sketchloc
