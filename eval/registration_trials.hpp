#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/registration_set.hpp"
#include "motion/random.hpp"
#include "registration/warp_predictor.hpp"

namespace sketchloc {

/// How wrong priors are that are drawn around the truth.
struct PriorSpread {
  double shift_m = 1.0;          ///< >= 0
  double turn_rad = 0.26;        ///< in [0, pi]
  double log_scale_sigma = 0.1;  ///< >= 0
  /// Every prior is off by exactly shift_m, in any direction, and by turn_rad, to either side; else
  /// uniform within.
  bool exact = false;
};

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const PriorSpread& spread);

Sim2 prior_around(const Sim2& sketch_from_robot, const PriorSpread& spread, Rng& rng);

/// A method with the name that tables have for it.
struct RegistrationMethodUse {
  std::string name;
  WarpPredictor* predictor = nullptr;  ///< none: the prior is the answer, what all others must beat
  bool present_scan_only = false;
};

/// The scans of a step that a method looks at.
std::vector<PlacedScan> submap_for(const RegistrationMethodUse& method,
                                   const RegistrationStep& step);

/// What a method says to steps[index] of a set from a prior; none where it says nothing.
std::optional<Registration> ask(const RegistrationSet& set, std::size_t index,
                                const RegistrationMethodUse& method,
                                const Sim2& prior_sketch_from_robot);

/// What a method said to one question.
struct RegistrationTrial {
  std::string set;
  std::string kind;      ///< of the set
  std::string protocol;  ///< see the two functions below
  std::string method;
  std::size_t index = 0;  ///< into the set's steps
  RegistrationError prior;
  bool found = false;       ///< else the prior is taken for the pose
  RegistrationError error;  ///< of the pose
  double log_scale_error = 0.0;
  std::optional<double> nees_position;  ///< 2 degrees of freedom; none without a covariance
  std::optional<double> nees_pose;      ///< position and heading, 3 degrees of freedom
  double inlier_probability = 1.0;
  double prior_alignment = 0.0;  ///< alignment_score of the prior
  double alignment = 0.0;        ///< and of the pose, both without bending
  double milliseconds = 0.0;     ///< of all that the method did for it
};

/// [Chen20]: along the trajectory, from the true pose at its first step, the prior is the last pose
/// moved by the odometry. A method that errs looks from there. Protocol "chained".
std::vector<RegistrationTrial> run_chained(const RegistrationSet& set,
                                           const RegistrationMethodUse& method);

/// Every step by itself, the same priors for all methods. `protocol` names the spread.
std::vector<RegistrationTrial> run_around_truth(const RegistrationSet& set,
                                                const RegistrationMethodUse& method,
                                                const std::string& protocol,
                                                const PriorSpread& spread, std::uint64_t seed);

/// A table of trials, a line each, without the times.
std::string trials_csv(std::span<const RegistrationTrial> trials);

}  // namespace sketchloc
