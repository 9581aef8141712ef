#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "filter/predict.hpp"
#include "filter/resample.hpp"

namespace sketchloc {
namespace {

constexpr std::size_t kCount = 40000;
constexpr double kStandardErrors = 5.0;
const Se2 kStep = Se2::from_xy_yaw(1.0, 0.0, 0.1);

/// All at the origin, heading along x, 1 px/m, without strain: motion is linear in its noise.
ParticleSet particles_at_origin() {
  ParticleSet particles;
  particles.resize(kCount);
  return particles;
}

PredictParams noisy_motion() {
  PredictParams params = metric_motion();
  params.odometry = {
      .slip_m_per_m = 0.0, .slip_m_per_rad = 0.0, .turn_rad_per_m = 0.0, .turn_rad_per_rad = 0.0};
  params.deformation = {.length_m = 0.4,
                        .shear_m = 0.2,
                        .heading_rad = 0.1,
                        .log_scale = 0.15,
                        .scale_memory_m = 3.0,
                        .log_mean_scale = 0.2,
                        .strain = 0.1,
                        .strain_memory_m = 1e9};
  return params;
}

/// Seven numbers: x, y, heading, log scale, log mean scale, both strains.
using State = Eigen::Matrix<double, 7, 1>;
using StateMatrix = Eigen::Matrix<double, 7, 7>;

struct Gaussian {
  State mean = State::Zero();
  StateMatrix covariance = StateMatrix::Zero();
};

/// What the motion makes of the particles at the origin.
Gaussian predicted() {
  const DeformationWalk walk = noisy_motion().deformation;
  const double forgotten = -std::expm1(-1.0 / walk.scale_memory_m);
  Gaussian state;
  state.mean << 1.0, 0.0, 0.1, 0.0, 0.0, 0.0, 0.0;
  const double mean_variance = walk.log_mean_scale * walk.log_mean_scale;
  state.covariance.diagonal() << walk.length_m * walk.length_m, walk.shear_m * walk.shear_m,
      walk.heading_rad * walk.heading_rad,
      walk.log_scale * walk.log_scale + forgotten * forgotten * mean_variance, mean_variance,
      walk.strain * walk.strain, walk.strain * walk.strain;
  state.covariance(3, 4) = state.covariance(4, 3) = forgotten * mean_variance;
  return state;
}

PoseLikelihood some_likelihood() {
  PoseLikelihood likelihood;
  likelihood.mean << 1.3, -0.2, 0.2, 0.1;
  likelihood.covariance << 0.09, 0.03, 0.0, 0.0,  //
      0.03, 0.04, 0.005, 0.0,                     //
      0.0, 0.005, 0.01, 0.004,                    //
      0.0, 0.0, 0.004, 0.02;
  likelihood.strain = {0.1, -0.05};
  likelihood.strain_sigma = 0.15;
  likelihood.outlier = 1e-9;
  likelihood.inlier = 1.0;
  return likelihood;
}

/// The Kalman filter's answer, and the integral of prior times likelihood without its outliers.
struct Answer {
  Gaussian posterior;
  double evidence = 0.0;
};

Answer exact_answer(const Gaussian& prior, const PoseLikelihood& likelihood) {
  Eigen::Matrix<double, 6, 7> seen = Eigen::Matrix<double, 6, 7>::Zero();
  seen.topLeftCorner<4, 4>().setIdentity();
  seen(4, 5) = seen(5, 6) = 1.0;
  Eigen::Matrix<double, 6, 6> noise = Eigen::Matrix<double, 6, 6>::Zero();
  noise.topLeftCorner<4, 4>() = likelihood.covariance;
  noise(4, 4) = noise(5, 5) = likelihood.strain_sigma * likelihood.strain_sigma;
  Eigen::Matrix<double, 6, 1> said;
  said << likelihood.mean, likelihood.strain;
  const Eigen::Matrix<double, 6, 6> innovation = seen * prior.covariance * seen.transpose() + noise;
  const Eigen::Matrix<double, 6, 1> off = said - seen * prior.mean;
  const Eigen::Matrix<double, 7, 6> gain =
      prior.covariance * seen.transpose() * innovation.inverse();
  Answer answer;
  answer.posterior.mean = prior.mean + gain * off;
  answer.posterior.covariance = prior.covariance - gain * seen * prior.covariance;
  answer.evidence = std::sqrt(noise.determinant() / innovation.determinant()) *
                    std::exp(-0.5 * off.dot(innovation.inverse() * off));
  return answer;
}

std::vector<State> states_of(const ParticleSet& particles) {
  std::vector<State> states;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    State state;
    state << particles.x_px[i], particles.y_px[i], particles.heading_rad[i], particles.log_scale[i],
        particles.log_mean_scale[i], particles.axial_strain[i], particles.diagonal_strain[i];
    states.push_back(state);
  }
  return states;
}

/// Mean and covariance of weighted particles against a Gaussian, within standard errors.
void expect_distributed(const ParticleSet& particles, const Gaussian& expected) {
  const std::vector<State> states = states_of(particles);
  double weight_sum = 0.0;
  double square_sum = 0.0;
  State mean = State::Zero();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const double weight = std::exp(particles.log_weight[i]);
    weight_sum += weight;
    square_sum += weight * weight;
    mean += weight * states[i];
  }
  mean /= weight_sum;
  StateMatrix covariance = StateMatrix::Zero();
  for (std::size_t i = 0; i < states.size(); ++i) {
    covariance += std::exp(particles.log_weight[i]) / weight_sum * (states[i] - mean) *
                  (states[i] - mean).transpose();
  }
  const double effective = weight_sum * weight_sum / square_sum;
  const auto& truth = expected.covariance;
  for (int row = 0; row < 7; ++row) {
    EXPECT_NEAR(mean[row], expected.mean[row],
                kStandardErrors * std::sqrt(truth(row, row) / effective))
        << row;
    for (int column = 0; column <= row; ++column) {
      const double error = std::sqrt(
          (truth(row, row) * truth(column, column) + truth(row, column) * truth(row, column)) /
          effective);
      EXPECT_NEAR(covariance(row, column), truth(row, column), kStandardErrors * error)
          << row << ", " << column;
    }
  }
}

TEST(ProposeStatistical, LeavesTheExactPosteriorInTheLinearGaussianCase) {
  ParticleSet particles = particles_at_origin();
  const std::vector<std::int8_t> first(kCount, 0);
  const PoseLikelihood likelihood = some_likelihood();
  Rng rng = make_rng(5);
  propose(particles, {0, kCount}, kStep, noisy_motion(), {&likelihood, 1}, first, rng);
  const Answer answer = exact_answer(predicted(), likelihood);
  expect_distributed(particles, answer.posterior);
  for (const float log_weight : particles.log_weight) {  // all came from one place
    EXPECT_NEAR(log_weight, std::log(answer.evidence), 1e-4);
  }
}

TEST(ProposeStatistical, LeavesTheExactPosteriorOfParticlesThatDiffer) {
  // Two heaps of particles; what each is worth is the evidence.
  ParticleSet particles = particles_at_origin();
  for (std::size_t i = 0; i < kCount / 2; ++i) {
    particles.x_px[i] = 0.5F;
  }
  const std::vector<std::int8_t> first(kCount, 0);
  const PoseLikelihood likelihood = some_likelihood();
  Rng rng = make_rng(6);
  propose(particles, {0, kCount}, kStep, noisy_motion(), {&likelihood, 1}, first, rng);
  Gaussian ahead = predicted();
  ahead.mean[0] += 0.5;
  const Answer behind = exact_answer(predicted(), likelihood);
  const Answer forward = exact_answer(ahead, likelihood);
  EXPECT_NEAR(particles.log_weight[0] - particles.log_weight[kCount - 1],
              std::log(forward.evidence / behind.evidence), 1e-4);
}

TEST(ProposeStatistical, KeepsTheMotionWhereTheRegistrationIsAnOutlier) {
  ParticleSet particles = particles_at_origin();
  const std::vector<std::int8_t> first(kCount, 0);
  PoseLikelihood likelihood = some_likelihood();
  likelihood.mean[0] = 50.0;
  likelihood.outlier = 0.25;
  Rng rng = make_rng(7);
  propose(particles, {0, kCount}, kStep, noisy_motion(), {&likelihood, 1}, first, rng);
  expect_distributed(particles, predicted());
  EXPECT_NEAR(particles.log_weight[0], std::log(0.25), 1e-5);
}

TEST(ProposeStatistical, MixesMotionAndProductByWhatTheyAreWorth) {
  // As much evidence for an outlier as for an inlier: half of the particles follow each.
  ParticleSet particles = particles_at_origin();
  const std::vector<std::int8_t> first(kCount, 0);
  PoseLikelihood likelihood = some_likelihood();
  likelihood.mean[0] = 1.6;
  const Answer answer = exact_answer(predicted(), likelihood);
  likelihood.outlier = answer.evidence;
  Rng rng = make_rng(10);
  propose(particles, {0, kCount}, kStep, noisy_motion(), {&likelihood, 1}, first, rng);
  const double between = 0.5 * (answer.posterior.mean[0] - predicted().mean[0]);
  Gaussian mixture;
  mixture.mean = 0.5 * (answer.posterior.mean + predicted().mean);
  double sum = 0.0;
  double squares = 0.0;
  for (const float x : particles.x_px) {
    sum += x;
    squares += (x - mixture.mean[0]) * (x - mixture.mean[0]);
  }
  const double variance =
      0.5 * (answer.posterior.covariance(0, 0) + predicted().covariance(0, 0)) + between * between;
  EXPECT_NEAR(sum / kCount, mixture.mean[0],
              kStandardErrors * std::sqrt(variance / static_cast<double>(kCount)));
  EXPECT_NEAR(squares / kCount, variance,
              kStandardErrors * variance * std::sqrt(3.0 / static_cast<double>(kCount)));
  EXPECT_NEAR(particles.log_weight[0], std::log(2.0 * answer.evidence), 1e-4);
}

TEST(Propose, TakesTheOthersForOutliers) {
  ParticleSet particles = particles_at_origin();
  std::vector<std::int8_t> which(kCount, kNoLikelihood);
  which[1] = 1;
  std::vector<PoseLikelihood> likelihoods(2, some_likelihood());
  likelihoods[0].outlier = 0.2;
  likelihoods[1].outlier = 0.5;
  Rng rng = make_rng(8);
  propose(particles, {0, 2}, kStep, noisy_motion(), likelihoods, which, rng);
  EXPECT_EQ(particles.log_weight[0], 0.0F);  // nobody asked about it
  const double fit = exact_answer(predicted(), likelihoods[1]).evidence;
  EXPECT_NEAR(particles.log_weight[1], std::log(0.2 * (0.5 + fit)), 1e-4);
}

TEST(Propose, WeighsARobotThatStandsStillWithoutMovingIt) {
  ParticleSet particles = particles_at_origin();
  const std::vector<std::int8_t> first(kCount, 0);
  PoseLikelihood likelihood = some_likelihood();
  likelihood.mean.setZero();
  likelihood.strain.setZero();
  Rng rng = make_rng(9);
  propose(particles, {0, 10}, Se2(), noisy_motion(), {&likelihood, 1}, first, rng);
  EXPECT_EQ(particles.x_px[3], 0.0F);
  EXPECT_EQ(particles.axial_strain[3], 0.0F);
  EXPECT_NEAR(particles.log_weight[3], 0.0, 1e-6);  // where it is, it is wholly right
}

}  // namespace
}  // namespace sketchloc
