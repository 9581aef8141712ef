#include "filter/predict.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <random>
#include <vector>

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

/// Draws one particle's motion after another.
class Mover {
 public:
  Mover(const Se2& robot_from_next, const PredictParams& params, Rng& rng)
      : noise_(step_noise(robot_from_next, params)),
        across_(-noise_.along.y(), noise_.along.x()),
        rng_(rng) {}

  const StepNoise& noise() const { return noise_; }

  /// Covariance of the way in the robot frame, m^2.
  Eigen::Matrix2f way_covariance() const {
    return noise_.along_m * noise_.along_m * noise_.along * noise_.along.transpose() +
           noise_.across_m * noise_.across_m * across_ * across_.transpose() +
           noise_.slip_m * noise_.slip_m * Eigen::Matrix2f::Identity();
  }

  float draw(float sigma) { return sigma > 0.0F ? sigma * normal_(rng_) : 0.0F; }

  void move(ParticleSet& particles, std::size_t i) {
    const Eigen::Vector2f slip_m(draw(noise_.slip_m), draw(noise_.slip_m));
    const Eigen::Vector2f step_in_robot_m = noise_.way_m + noise_.along * draw(noise_.along_m) +
                                            across_ * draw(noise_.across_m) + slip_m;
    const Eigen::Vector2f step_px = step_in_sketch(particles, i, step_in_robot_m);
    particles.x_px[i] += step_px.x();
    particles.y_px[i] += step_px.y();
    particles.heading_rad[i] =
        wrapped(particles.heading_rad[i] + noise_.turn_rad + draw(noise_.heading_rad));
    particles.log_mean_scale[i] += draw(noise_.log_mean_scale);
    particles.log_scale[i] +=
        noise_.scale_forgotten * (particles.log_mean_scale[i] - particles.log_scale[i]) +
        draw(noise_.log_scale);
    particles.axial_strain[i] *= 1.0F - noise_.strain_forgotten;
    particles.axial_strain[i] += draw(noise_.strain);
    particles.diagonal_strain[i] *= 1.0F - noise_.strain_forgotten;
    particles.diagonal_strain[i] += draw(noise_.strain);
  }

 private:
  StepNoise noise_;
  Eigen::Vector2f across_;
  Rng& rng_;
  std::normal_distribution<float> normal_;  // of this call alone, its spare value too
};

Eigen::Vector4d pose_of(const ParticleSet& particles, std::size_t i) {
  return {particles.x_px[i], particles.y_px[i], particles.heading_rad[i], particles.log_scale[i]};
}

/// Where a particle goes if nothing errs, and the covariance of its motion's noise.
struct Motion {
  Eigen::Vector4d mean;
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
};

Motion motion_of(const ParticleSet& particles, std::size_t i, const Mover& mover) {
  const StepNoise& noise = mover.noise();
  Eigen::Matrix2f map;
  map.col(0) = step_in_sketch(particles, i, Eigen::Vector2f::UnitX());
  map.col(1) = step_in_sketch(particles, i, Eigen::Vector2f::UnitY());
  const Eigen::Vector2f step_px = map * noise.way_m;
  Motion motion;
  motion.mean = pose_of(particles, i);
  motion.mean.head<2>() += step_px.cast<double>();
  motion.mean[2] += noise.turn_rad;
  motion.mean[3] += noise.scale_forgotten * (particles.log_mean_scale[i] - particles.log_scale[i]);
  motion.covariance.topLeftCorner<2, 2>() =
      (map * mover.way_covariance() * map.transpose()).cast<double>();
  motion.covariance(2, 2) = noise.heading_rad * noise.heading_rad;
  const float through_mean = noise.scale_forgotten * noise.log_mean_scale;
  motion.covariance(3, 3) = noise.log_scale * noise.log_scale + through_mean * through_mean;
  return motion;
}

Eigen::Vector4d pose_difference(const Eigen::Vector4d& pose, const Eigen::Vector4d& other) {
  Eigen::Vector4d difference = pose - other;
  difference[2] = wrap_rad(difference[2]);
  return difference;
}

/// A likelihood with what all particles need of it.
struct PreparedLikelihood {
  PoseLikelihood likelihood;
  Eigen::Matrix4d root;  ///< lower triangular, of its covariance
  double log_root_determinant = 0.0;
  double others_outliers = 1.0;  ///< product of the others' outlier likelihoods
};

std::vector<PreparedLikelihood> prepared(std::span<const PoseLikelihood> likelihoods) {
  std::vector<PreparedLikelihood> result;
  for (const PoseLikelihood& likelihood : likelihoods) {
    const Eigen::Matrix4d root = likelihood.covariance.llt().matrixL();
    result.push_back({.likelihood = likelihood,
                      .root = root,
                      .log_root_determinant = root.diagonal().array().log().sum()});
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    for (std::size_t j = 0; j < result.size(); ++j) {
      result[i].others_outliers *= j == i ? 1.0 : likelihoods[j].outlier;
    }
  }
  return result;
}

/// Draws from motion times likelihood; returns the log of their product's integral.
double propose_one(ParticleSet& particles, std::size_t i, const PreparedLikelihood& said,
                   Mover& mover, Rng& rng) {
  const PoseLikelihood& likelihood = said.likelihood;
  const Motion motion = motion_of(particles, i, mover);
  const Eigen::LLT<Eigen::Matrix4d> innovation(motion.covariance + likelihood.covariance);
  const Eigen::Vector4d off = pose_difference(likelihood.mean, motion.mean);
  const double log_root_determinant = innovation.matrixLLT().diagonal().array().log().sum();
  const double strain_noise = mover.noise().strain * mover.noise().strain;
  const double strain_said = likelihood.strain_sigma * likelihood.strain_sigma;
  const double strain_gain = strain_noise / (strain_noise + strain_said);
  const float kept = 1.0F - mover.noise().strain_forgotten;
  const Eigen::Vector2d strain_off =
      likelihood.strain -
      Eigen::Vector2d(kept * particles.axial_strain[i], kept * particles.diagonal_strain[i]);
  const double fit = likelihood.inlier * (1.0 - strain_gain) *
                     std::exp(said.log_root_determinant - log_root_determinant -
                              0.5 * innovation.matrixL().solve(off).squaredNorm() -
                              0.5 * strain_off.squaredNorm() / (strain_noise + strain_said));
  const bool is_inlier = uniform(rng) * (likelihood.outlier + fit) < fit;
  mover.move(particles, i);
  if (is_inlier) {
    // A draw x of the motion and one of what the registration may have said had x been true: their
    // difference, through the gain, turns x into a draw of the product. (Matheron's rule.)
    Eigen::Vector4d error;
    for (int row = 0; row < 4; ++row) {
      error[row] = gaussian(1.0, rng);
    }
    const Eigen::Vector4d seen = said.root.triangularView<Eigen::Lower>() * error;
    const Eigen::Vector4d pull =
        innovation.solve(pose_difference(likelihood.mean, pose_of(particles, i)) - seen);
    const Eigen::Vector4d change = motion.covariance * pull;
    const StepNoise& noise = mover.noise();
    particles.x_px[i] += static_cast<float>(change[0]);
    particles.y_px[i] += static_cast<float>(change[1]);
    particles.heading_rad[i] = wrapped(particles.heading_rad[i] + static_cast<float>(change[2]));
    particles.log_scale[i] += static_cast<float>(change[3]);
    const auto pulled = [&](float strain, double said_strain) {
      return strain + static_cast<float>(strain_gain * (said_strain - static_cast<double>(strain) -
                                                        gaussian(likelihood.strain_sigma, rng)));
    };
    particles.axial_strain[i] = pulled(particles.axial_strain[i], likelihood.strain.x());
    particles.diagonal_strain[i] = pulled(particles.diagonal_strain[i], likelihood.strain.y());
    particles.log_mean_scale[i] += noise.scale_forgotten * noise.log_mean_scale *
                                   noise.log_mean_scale * static_cast<float>(pull[3]);
  }
  return std::log((likelihood.outlier + fit) * said.others_outliers);
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
  Mover mover(robot_from_next, params, rng);
  for (std::size_t i = range.begin; i < range.end; ++i) {
    mover.move(particles, i);
  }
}

void propose(ParticleSet& particles, const ParticleRange& range, const Se2& robot_from_next,
             const PredictParams& params, std::span<const PoseLikelihood> likelihoods,
             std::span<const std::int8_t> likelihood_of, Rng& rng) {
  const std::vector<PreparedLikelihood> said = prepared(likelihoods);
  Mover mover(robot_from_next, params, rng);
  for (std::size_t i = range.begin; i < range.end; ++i) {
    if (likelihood_of[i] == kNoLikelihood) {
      mover.move(particles, i);
    } else {
      const auto which = static_cast<std::size_t>(likelihood_of[i]);
      particles.log_weight[i] +=
          static_cast<float>(propose_one(particles, i, said[which], mover, rng));
    }
  }
}

}  // namespace sketchloc
