#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "filter/particle_set.hpp"
#include "filter/pose_likelihood.hpp"
#include "motion/odometry.hpp"
#include "motion/random.hpp"

namespace sketchloc {

/// How a drawing departs from the metres driven in it, on top of the odometry's own noise. All are
/// walks: 1-sigma after one metre, growing with the square root of the way, so that it does not
/// matter how often the robot scans. Fitted together on the Intel and Belgioioso drawings, see
/// docs/results/real.md.
struct DeformationWalk {
  double length_m = 0.22;        ///< walk of the place along the way: drawn lengths, >= 0
  double shear_m = 0.15;         ///< the same across the way, >= 0
  double heading_rad = 0.05;     ///< walk of the local rotation, >= 0
  double log_scale = 0.08;       ///< walk of the local log scale, >= 0
  double scale_memory_m = 9.0;   ///< way after which the local scale returns to its mean, > 0
  double log_mean_scale = 0.03;  ///< walk of that mean itself, >= 0
  double strain = 0.15;          ///< walk of either strain component, >= 0
  double strain_memory_m = 8.0;  ///< way after which the strain returns to none, > 0
};

template <typename Visitor>
void visit_fields(DeformationWalk& walk, Visitor&& visit) {
  visit("length_m", walk.length_m);
  visit("shear_m", walk.shear_m);
  visit("heading_rad", walk.heading_rad);
  visit("log_scale", walk.log_scale);
  visit("scale_memory_m", walk.scale_memory_m);
  visit("log_mean_scale", walk.log_mean_scale);
  visit("strain", walk.strain);
  visit("strain_memory_m", walk.strain_memory_m);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const DeformationWalk& walk);

struct PredictParams {
  OdometryNoise odometry{.slip_m_per_m = 0.02,
                         .slip_m_per_rad = 0.01,
                         .turn_rad_per_m = 0.01,
                         .turn_rad_per_rad = 0.03};  ///< of the odometry as refined by matching
  DeformationWalk deformation;
};

template <typename Visitor>
void visit_fields(PredictParams& params, Visitor&& visit) {
  visit("odometry", params.odometry);
  visit("deformation", params.deformation);
}

void validate(const PredictParams& params);

/// The same for a map in true proportions: nothing deforms.
PredictParams metric_motion();

/// A run of particles [begin, end) that one engine moves.
struct ParticleRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// Moves a range of particles by an odometry increment with noise; metres become pixels by each
/// particle's own local map. Without motion nothing changes and nothing is drawn.
void predict(ParticleSet& particles, const ParticleRange& range, const Se2& robot_from_next,
             const PredictParams& params, Rng& rng);

/// Of no likelihood: where no registration was asked about a particle.
inline constexpr std::int8_t kNoLikelihood = -1;

/// The same, knowing what registrations say about where the particles are now: each particle is
/// drawn from the product of its motion and its likelihood, the optimal proposal [Doucet00], and
/// weighted by how probable that likelihood was for it; the other likelihoods count as outliers.
/// `likelihood_of[i]` is the index of particle i's; a particle without one is moved as by predict.
/// Exact: the weighted particles represent motion times likelihood (docs/filter.md).
void propose(ParticleSet& particles, const ParticleRange& range, const Se2& robot_from_next,
             const PredictParams& params, std::span<const PoseLikelihood> likelihoods,
             std::span<const std::int8_t> likelihood_of, Rng& rng);

}  // namespace sketchloc
