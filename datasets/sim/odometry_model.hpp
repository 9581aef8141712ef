#pragma once

#include "motion/odometry.hpp"
#include "motion/random.hpp"
#include "motion/se2.hpp"

namespace sketchloc {

/// Wheel odometry as it is: errors that stay the same for a whole run, and noise on top. Defaults:
/// as measured on five indoor logs (Intel, Belgioioso, Freiburg 079 and 101, CSAIL) against poses
/// corrected by scan matching.
struct OdometryModel {
  double length_bias_sigma = 0.025;         ///< relative error of lengths per run, in [0, 0.3]
  double turn_bias_sigma_rad_per_m = 0.02;  ///< heading drift per metre, per run, in [0, 1]
  double turn_bias_sigma = 0.05;            ///< relative error of turns per run, in [0, 0.3]
  OdometryNoise noise = {.slip_m_per_m = 0.04,
                         .slip_m_per_rad = 0.01,
                         .turn_rad_per_m = 0.03,
                         .turn_rad_per_rad = 0.1};
};

template <typename Visitor>
void visit_fields(OdometryModel& odometry, Visitor&& visit) {
  visit("length_bias_sigma", odometry.length_bias_sigma);
  visit("turn_bias_sigma_rad_per_m", odometry.turn_bias_sigma_rad_per_m);
  visit("turn_bias_sigma", odometry.turn_bias_sigma);
  visit("noise", odometry.noise);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const OdometryModel& odometry);

/// The odometry of one run: its biases are drawn once, when it is made.
class OdometrySimulator {
 public:
  OdometrySimulator(const OdometryModel& model, Rng& rng);

  /// The increment that the wheels report for a true one.
  Se2 measured(const Se2& robot_from_next, Rng& rng) const;

 private:
  OdometryNoise noise_;
  double length_factor_;
  double turn_rad_per_m_;
  double turn_factor_;
};

}  // namespace sketchloc
