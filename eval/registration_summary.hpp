#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/intervals.hpp"
#include "eval/mean_over_sets.hpp"
#include "eval/registration_trials.hpp"
#include "eval/summary.hpp"

namespace sketchloc {

/// How often a stated covariance holds, of those that were stated.
struct Coverage {
  double pose_68 = 0.0;  ///< position and heading inside of the 68 % ellipsoid, in [0, 1]
  double pose_95 = 0.0;
  double position_68 = 0.0;
  double position_95 = 0.0;
  std::size_t count = 0;
};

/// Trials whose stated inlier probability falls into a bin.
struct ReliabilityBin {
  double mean_stated = 0.0;
  double share_right = 0.0;
  Interval interval;  ///< of the share, Wilson
  std::size_t count = 0;
};

/// One line of the results: a method under a protocol on all sets of a kind.
struct RegistrationRow {
  std::string kind;
  std::string protocol;
  std::string method;
  std::size_t sets = 0;
  std::size_t trials = 0;
  std::size_t failures = 0;  ///< trials without an answer: their prior counts
  ErrorSummary prior_m;
  ErrorSummary position_m;
  ErrorSummary heading_rad;
  MeanOverSets mean_position_m;
  MeanOverSets mean_heading_rad;
  MeanOverSets share_nearer;            ///< trials whose pose is nearer to the truth than the prior
  MeanOverSets share_right;             ///< trials that are right, see is_right
  double log_scale_error_median = 0.0;  ///< of absolute values
  std::optional<Coverage> coverage;
  std::vector<ReliabilityBin> reliability;
  double inlier_brier = 0.0;    ///< mean squared error of the inlier probability
  MeanOverSets alignment_gain;  ///< alignment score of the pose minus that of the prior
  MeanOverSets share_aligned;   ///< trials whose pose has a better alignment score than the prior
  double median_ms = 0.0;
};

/// Within 0.5 m and 15 deg: what the inlier probability is about.
bool is_right(const RegistrationTrial& trial);

/// One row for each kind, protocol and method, in the order of their first trials.
std::vector<RegistrationRow> summarize_registration(std::span<const RegistrationTrial> trials,
                                                    std::uint64_t seed = 1);

/// Mean error of a method minus that of another on the same questions, with its interval.
struct RegistrationDifference {
  std::string kind;
  std::string protocol;
  std::string method;
  std::string other;
  MeanOverSets position_m;
  MeanOverSets heading_rad;
};

/// Of the first method against each other one.
std::vector<RegistrationDifference> compare_registration(std::span<const RegistrationTrial> trials,
                                                         const std::string& method,
                                                         std::uint64_t seed = 1);

/// Everything but the times as JSON: the same for the same seed.
std::string registration_json(std::span<const RegistrationRow> rows,
                              std::span<const RegistrationDifference> differences);

/// What a registration took, ms; another one every time.
std::string registration_timing_json(std::span<const RegistrationRow> rows);

/// A table for a document.
std::string registration_markdown(std::span<const RegistrationRow> rows);

}  // namespace sketchloc
