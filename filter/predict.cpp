#include "filter/predict.hpp"

#include <cmath>
#include <random>

#include "motion/angles.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

/// The noise of one step, all 1-sigma, and the shares of the walks that are forgotten.
struct StepNoise {
  Eigen::Vector2f way_m;  ///< the increment in the robot frame
  Eigen::Vector2f along;  ///< its direction; zero where there is no way
  float turn_rad = 0.0F;
  float along_m = 0.0F;
  float across_m = 0.0F;
  float slip_m = 0.0F;
  float heading_rad = 0.0F;
  float log_scale = 0.0F;
  float log_mean_scale = 0.0F;
  float strain = 0.0F;
  float scale_forgotten = 0.0F;
  float strain_forgotten = 0.0F;
};

StepNoise step_noise(const Se2& robot_from_next, const PredictParams& params) {
  const DeformationWalk& walk = params.deformation;
  const double way_m = robot_from_next.translation().norm();
  const double root_way = std::sqrt(way_m);
  const Eigen::Vector3d sigma = increment_sigma(robot_from_next, params.odometry);
  StepNoise noise;
  noise.way_m = robot_from_next.translation().cast<float>();
  noise.along = noise.way_m.normalized();
  noise.turn_rad = static_cast<float>(robot_from_next.yaw_rad());
  noise.along_m = static_cast<float>(walk.length_m * root_way);
  noise.across_m = static_cast<float>(walk.shear_m * root_way);
  noise.slip_m = static_cast<float>(sigma.x());
  noise.heading_rad = static_cast<float>(std::hypot(sigma.z(), walk.heading_rad * root_way));
  noise.log_scale = static_cast<float>(walk.log_scale * root_way);
  noise.log_mean_scale = static_cast<float>(walk.log_mean_scale * root_way);
  noise.strain = static_cast<float>(walk.strain * root_way);
  noise.scale_forgotten = static_cast<float>(-std::expm1(-way_m / walk.scale_memory_m));
  noise.strain_forgotten = static_cast<float>(-std::expm1(-way_m / walk.strain_memory_m));
  return noise;
}

float wrapped(float angle_rad) {
  constexpr float kTurn = 2.0F * std::numbers::pi_v<float>;
  return angle_rad - kTurn * std::nearbyint(angle_rad / kTurn);
}

/// J of ParticleSet applied to a small step in the robot frame.
Eigen::Vector2f step_in_sketch(const ParticleSet& particles, std::size_t i,
                               const Eigen::Vector2f& step_in_robot_m) {
  const float c = std::cos(particles.heading_rad[i]);
  const float s = std::sin(particles.heading_rad[i]);
  const float x = c * step_in_robot_m.x() - s * step_in_robot_m.y();
  const float y = s * step_in_robot_m.x() + c * step_in_robot_m.y();
  const float axial = particles.axial_strain[i];
  const float diagonal = particles.diagonal_strain[i];
  const float size = std::sqrt(axial * axial + diagonal * diagonal);
  const float scale = std::exp(particles.log_scale[i]);
  const float even = scale * std::cosh(size);
  const float odd = size > 1e-4F ? scale * std::sinh(size) / size : scale;
  return {(even + odd * axial) * x + odd * diagonal * y,
          odd * diagonal * x + (even - odd * axial) * y};
}

}  // namespace

void validate(const DeformationWalk& walk) {
  require_at_least("length_m", walk.length_m, 0.0);
  require_at_least("shear_m", walk.shear_m, 0.0);
  require_at_least("heading_rad", walk.heading_rad, 0.0);
  require_at_least("log_scale", walk.log_scale, 0.0);
  require_above("scale_memory_m", walk.scale_memory_m, 0.0);
  require_at_least("log_mean_scale", walk.log_mean_scale, 0.0);
  require_at_least("strain", walk.strain, 0.0);
  require_above("strain_memory_m", walk.strain_memory_m, 0.0);
}

void validate(const PredictParams& params) {
  validate_part("odometry", params.odometry);
  validate_part("deformation", params.deformation);
}

PredictParams metric_motion() {
  return {.odometry = {.slip_m_per_m = 0.05,
                       .slip_m_per_rad = 0.01,
                       .turn_rad_per_m = 0.02,
                       .turn_rad_per_rad = 0.05},
          .deformation = {.length_m = 0.0,
                          .shear_m = 0.0,
                          .heading_rad = 0.0,
                          .log_scale = 0.0,
                          .log_mean_scale = 0.0,
                          .strain = 0.0}};
}

void predict(ParticleSet& particles, const ParticleRange& range, const Se2& robot_from_next,
             const PredictParams& params, Rng& rng) {
  if (robot_from_next.translation().isZero(0.0) && robot_from_next.yaw_rad() == 0.0) {
    return;
  }
  const StepNoise noise = step_noise(robot_from_next, params);
  const Eigen::Vector2f across(-noise.along.y(), noise.along.x());
  std::normal_distribution<float> normal;  // local to the call, its spare value too
  const auto draw = [&](float sigma) { return sigma > 0.0F ? sigma * normal(rng) : 0.0F; };
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const Eigen::Vector2f slip_m(draw(noise.slip_m), draw(noise.slip_m));
    const Eigen::Vector2f step_in_robot_m =
        noise.way_m + noise.along * draw(noise.along_m) + across * draw(noise.across_m) + slip_m;
    const Eigen::Vector2f step_px = step_in_sketch(particles, i, step_in_robot_m);
    particles.x_px[i] += step_px.x();
    particles.y_px[i] += step_px.y();
    particles.heading_rad[i] =
        wrapped(particles.heading_rad[i] + noise.turn_rad + draw(noise.heading_rad));
    particles.log_mean_scale[i] += draw(noise.log_mean_scale);
    particles.log_scale[i] +=
        noise.scale_forgotten * (particles.log_mean_scale[i] - particles.log_scale[i]) +
        draw(noise.log_scale);
    particles.axial_strain[i] *= 1.0F - noise.strain_forgotten;
    particles.axial_strain[i] += draw(noise.strain);
    particles.diagonal_strain[i] *= 1.0F - noise.strain_forgotten;
    particles.diagonal_strain[i] += draw(noise.strain);
  }
}

}  // namespace sketchloc
