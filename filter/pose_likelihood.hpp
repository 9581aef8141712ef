#pragma once

#include <Eigen/Core>

#include "registration/warp_predictor.hpp"

namespace sketchloc {

/// What a registration says about the robot's pose x = (x px, y px, heading rad, log scale), sketch
/// frame, and the strain s of the drawing there (see ParticleSet), as a likelihood that is not
/// normalised:
///   L(x, s) = outlier + inlier exp(-(x - mean)^T covariance^-1 (x - mean) / 2
///                                  - |s - strain|^2 / (2 strain_sigma^2)),
/// the difference in heading wrapped. A registration that is wrong says nothing: it lies anywhere
/// that it could have been found.
struct PoseLikelihood {
  Eigen::Vector4d mean = Eigen::Vector4d::Zero();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Identity();
  Eigen::Vector2d strain = Eigen::Vector2d::Zero();  ///< axial, diagonal
  double strain_sigma = 1.0;                         ///< > 0
  double outlier = 0.5;                              ///< > 0
  double inlier = 0.5;                               ///< >= 0
};

/// How far a registration is believed.
struct PoseTrust {
  double inflation = 1.0;        ///< of its standard deviations, > 0
  double reach_m = 3.0;          ///< a wrong one lies anywhere so far from its prior, > 0
  double reach_rad = 0.8;        ///< and turned by so much, > 0
  double reach_log_scale = 0.5;  ///< and scaled, > 0
  double max_peak = 100.0;       ///< a right one counts no more, at its pose, than a wrong one
                                 ///< times this, >= 1
  double max_probability = 0.8;  ///< no registration is righter than this, in (0, 1)
  double min_position_m = 0.05;  ///< what no registration tells, 1-sigma, > 0
  double min_heading_rad = 0.02;
  double min_log_scale = 0.02;
  double strain_sigma = 0.2;  ///< of the strain that the warp has at the robot, > 0
};

template <typename Visitor>
void visit_fields(PoseTrust& trust, Visitor&& visit) {
  visit("inflation", trust.inflation);
  visit("reach_m", trust.reach_m);
  visit("reach_rad", trust.reach_rad);
  visit("reach_log_scale", trust.reach_log_scale);
  visit("max_peak", trust.max_peak);
  visit("max_probability", trust.max_probability);
  visit("min_position_m", trust.min_position_m);
  visit("min_heading_rad", trust.min_heading_rad);
  visit("min_log_scale", trust.min_log_scale);
  visit("strain_sigma", trust.strain_sigma);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const PoseTrust& trust);

/// `share`: how much of the registration is new, in (0, 1]; the rest errs as the one before did, so
/// the Gaussian counts as its power of this: it is widened. The registration has a covariance.
PoseLikelihood pose_likelihood(const Registration& registration, const PoseTrust& trust,
                               double share);

}  // namespace sketchloc
