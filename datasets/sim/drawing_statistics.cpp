#include "datasets/sim/drawing_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "motion/angles.hpp"
#include "motion/check.hpp"
#include "motion/quantile.hpp"

namespace sketchloc {
namespace {

constexpr double kSpacing_m = 0.2;     ///< of the places that are compared
constexpr double kLagTolerance = 0.2;  ///< of distances, relative

/// Residuals of the best similarity, in metres at its scale.
std::vector<Eigen::Vector2d> residuals_m(std::span<const DrawnPlace> places) {
  std::vector<Eigen::Vector2d> in_world;
  std::vector<Eigen::Vector2d> in_sketch;
  for (const DrawnPlace& place : places) {
    in_world.push_back(place.position_in_world);
    in_sketch.push_back(place.position_in_sketch);
  }
  const std::optional<Sim2> sketch_from_world = align_sim2(in_world, in_sketch);
  check(sketch_from_world.has_value(), "a drive has two different places");
  std::vector<Eigen::Vector2d> residuals;
  for (std::size_t i = 0; i < places.size(); ++i) {
    residuals.push_back((in_sketch[i] - *sketch_from_world * in_world[i]) /
                        sketch_from_world->scale());
  }
  return residuals;
}

double rms(const std::vector<Eigen::Vector2d>& errors) {
  double sum = 0.0;
  for (const Eigen::Vector2d& error : errors) {
    sum += error.squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

/// RMS difference of the residuals of two places that are lag_m apart (within a share of it).
double change_over(double lag_m, std::span<const DrawnPlace> places,
                   const std::vector<Eigen::Vector2d>& residuals) {
  std::vector<Eigen::Vector2d> changes;
  for (std::size_t first = 0; first < places.size(); ++first) {
    for (std::size_t second = first + 1; second < places.size(); ++second) {
      const double distance_m =
          (places[second].position_in_world - places[first].position_in_world).norm();
      if (std::abs(distance_m - lag_m) < kLagTolerance * lag_m) {
        changes.emplace_back(residuals[second] - residuals[first]);
      }
    }
  }
  return changes.empty() ? std::numeric_limits<double>::quiet_NaN() : rms(changes);
}

/// Places at equal distances of way, so that a robot that turns on the spot does not count double.
std::vector<DrawnPlace> spread_evenly(std::span<const DrawnPlace> places) {
  std::vector<DrawnPlace> even{places.front()};
  double since_last_m = 0.0;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const DrawnPlace& before = places[i - 1];
    const Eigen::Vector2d step = places[i].position_in_world - before.position_in_world;
    const Eigen::Vector2d drawn = places[i].position_in_sketch - before.position_in_sketch;
    const double step_m = step.norm();
    double reached_m = kSpacing_m - since_last_m;
    for (; reached_m <= step_m; reached_m += kSpacing_m) {
      const double share = reached_m / step_m;
      even.push_back({before.position_in_world + share * step,
                      before.position_in_sketch + share * drawn, before.local});
    }
    since_last_m = step_m - (reached_m - kSpacing_m);
  }
  return even;
}

Quantiles rotation_quantiles(std::span<const DrawnPlace> places) {
  std::complex<double> sum = 0.0;
  for (const DrawnPlace& place : places) {
    sum += std::polar(1.0, place.local.rotation_rad);
  }
  const double middle_rad = std::arg(sum);
  std::vector<double> around_middle_rad;
  for (const DrawnPlace& place : places) {
    around_middle_rad.push_back(middle_rad + wrap_rad(place.local.rotation_rad - middle_rad));
  }
  return quantiles(std::move(around_middle_rad));
}

}  // namespace

Quantiles quantiles(std::vector<double> values) {
  check(!values.empty(), "quantiles need a value");
  std::sort(values.begin(), values.end());
  return {quantile_of_sorted(values, 0.05), quantile_of_sorted(values, 0.5),
          quantile_of_sorted(values, 0.95)};
}

DrawingStatistics measure_drawing(std::span<const DrawnPlace> drive) {
  check(drive.size() >= 2, "statistics need two places");
  const std::vector<DrawnPlace> places = spread_evenly(drive);
  std::vector<double> scales;
  std::vector<double> anisotropies;
  for (const DrawnPlace& place : places) {
    scales.push_back(place.local.scale);
    anisotropies.push_back(place.local.anisotropy);
  }
  const std::vector<Eigen::Vector2d> residuals = residuals_m(places);
  DrawingStatistics statistics{.scale_px_per_m = quantiles(std::move(scales)),
                               .rotation_rad = rotation_quantiles(places),
                               .anisotropy = quantiles(std::move(anisotropies)),
                               .residual_rms_m = rms(residuals)};
  for (std::size_t i = 0; i < statistics.residual_change_m.size(); ++i) {
    statistics.residual_change_m[i] = change_over(DrawingStatistics::kLags_m[i], places, residuals);
  }
  return statistics;
}

std::vector<DrawnPlace> drawn_places(const MetricTrajectory& world_from_robot,
                                     const Deformation& sketch_from_world) {
  std::vector<DrawnPlace> places;
  for (const Stamped<Se2>& truth : world_from_robot) {
    const PlaneMapPoint there = sketch_from_world.at(truth.pose.translation());
    places.push_back({truth.pose.translation(), there.value, local_similarity(there.jacobian)});
  }
  return places;
}

}  // namespace sketchloc
