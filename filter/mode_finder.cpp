#include "filter/mode_finder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/angles.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

constexpr int kMeanShiftSteps = 4;

/// Weighted sums of the particles around a place; offsets from it, so that float suffices.
struct Sums {
  double weight = 0.0;
  Eigen::Vector4d first = Eigen::Vector4d::Zero();
  Eigen::Matrix4d second = Eigen::Matrix4d::Zero();
};

/// Calls visit(index, offset from (x, y, heading)) for each particle within the radii.
template <typename Visit>
void for_each_near(const ParticleSet& particles, const Eigen::Vector3f& place, float radius_px,
                   float radius_rad, Visit&& visit) {
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const float dx = particles.x_px[i] - place.x();
    const float dy = particles.y_px[i] - place.y();
    if (dx * dx + dy * dy > radius_px * radius_px) {
      continue;
    }
    const float turn_rad = wrap_rad(particles.heading_rad[i] - place.z());
    if (std::abs(turn_rad) <= radius_rad) {
      visit(i, Eigen::Vector3f(dx, dy, turn_rad));
    }
  }
}

}  // namespace

void validate(const ModeParams& params) {
  require_above("radius_m", params.radius_m, 0.0);
  require_in_range("radius_rad", params.radius_rad, kMinBinRad, std::numbers::pi);
  require_in_range("max_modes", params.max_modes, 1, 16);
  require_in_range("min_weight", params.min_weight, 0.0, 1.0);
}

ModeFinder::ModeFinder(const ModeParams& params, std::size_t max_particles)
    : params_(params), cells_(max_particles) {
  weight_.reserve(max_particles);
}

void ModeFinder::find(const ParticleSet& particles, Estimate& estimate) {
  const float share = 1.0F / static_cast<float>(particles.size());
  weight_.resize(particles.size());
  double log_scale = 0.0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    weight_[i] = share * std::exp(particles.log_weight[i]);
    log_scale += static_cast<double>(weight_[i]) * particles.log_scale[i];
  }
  const double radius_px = params_.radius_m * std::exp(log_scale);
  estimate.modes.clear();
  for (int found = 0; found < params_.max_modes; ++found) {
    const Seed seed = heaviest_cell(particles, radius_px);
    if (seed.weight <= 0.0) {
      break;
    }
    const Mode mode = mean_shift(particles, seed, radius_px);
    if (!estimate.modes.empty() && mode.weight < params_.min_weight) {
      break;
    }
    claim(particles, mode, radius_px);
    estimate.modes.push_back(mode);
  }
  std::ranges::sort(estimate.modes, std::greater<>(), &Mode::weight);
  estimate.sketch_from_robot = estimate.modes.front().sketch_from_robot;
  estimate.covariance = estimate.modes.front().covariance;
}

ModeFinder::Seed ModeFinder::heaviest_cell(const ParticleSet& particles, double radius_px) {
  cells_.clear();
  Seed best;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (weight_[i] <= 0.0F) {
      continue;
    }
    const double weight =
        cells_.add(pose_bin(particles.x_px[i], particles.y_px[i], particles.heading_rad[i],
                            radius_px / 2.0, params_.radius_rad),
                   weight_[i]);
    if (weight > best.weight) {
      best = {particles.x_px[i], particles.y_px[i], particles.heading_rad[i], weight};
    }
  }
  return best;
}

Mode ModeFinder::mean_shift(const ParticleSet& particles, const Seed& seed,
                            double radius_px) const {
  Eigen::Vector3d place(seed.x, seed.y, seed.heading_rad);
  Sums sums;
  for (int step = 0; step <= kMeanShiftSteps; ++step) {
    if (sums.weight > 0.0) {
      place += sums.first.head<3>() / sums.weight;
    }
    sums = {};
    for_each_near(
        particles, place.cast<float>(), static_cast<float>(radius_px),
        static_cast<float>(params_.radius_rad), [&](std::size_t i, const Eigen::Vector3f& offset) {
          const double w = weight_[i];
          const Eigen::Vector4d d(offset.x(), offset.y(), offset.z(), particles.log_scale[i]);
          sums.weight += w;
          sums.first += w * d;
          sums.second += w * d * d.transpose();
        });
    if (sums.weight <= 0.0) {
      break;
    }
  }
  const double weight = std::max(sums.weight, 1e-300);
  const Eigen::Vector4d mean = sums.first / weight;
  Mode mode;
  mode.weight = sums.weight;
  mode.covariance = sums.second / weight - mean * mean.transpose();
  mode.sketch_from_robot =
      Sim2::from_xy_yaw_scale(place.x() + mean.x(), place.y() + mean.y(),
                              wrap_rad(place.z() + mean.z()), std::exp(mean[3]));
  return mode;
}

void ModeFinder::claim(const ParticleSet& particles, const Mode& mode, double radius_px) {
  const Sim2& pose = mode.sketch_from_robot;
  bool claimed_any = false;
  for_each_near(particles, Eigen::Vector3d(pose.x(), pose.y(), pose.yaw_rad()).cast<float>(),
                static_cast<float>(radius_px), static_cast<float>(params_.radius_rad),
                [&](std::size_t i, const Eigen::Vector3f&) {
                  weight_[i] = 0.0F;
                  claimed_any = true;
                });
  if (!claimed_any) {
    std::ranges::fill(weight_, 0.0F);
  }
}

}  // namespace sketchloc
