#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "datasets/run.hpp"
#include "eval/odometry_drift.hpp"

namespace sketchloc {

struct OdometryComparisonParams {
  double max_gap_s = 0.01;          ///< between the time of a relation and that of a pose, >= 0
  double long_relation_s = 60.0;    ///< relations over more time than this are long, > 0
  double reference_sigma_m = 0.02;  ///< of a corrected increment itself, along each axis, >= 0
  double reference_sigma_rad = 0.005;
};

/// Errors of one odometry against one kind of reference.
struct OdometryErrors {
  std::string odometry;   ///< wheels, matched or corrected
  std::string reference;  ///< such as "relations up to 60 s"
  PoseErrors errors;      ///< none where there was nothing to compare
};

/// Whether the covariance of the matched increments tells their errors; 3 degrees of freedom.
struct IncrementHonesty {
  double median_nees = 0.0;  ///< 2.37 for an honest one
  double p90_nees = 0.0;     ///< 6.25
  double share_in_95 = 0.0;  ///< increments inside their 95 % ellipsoid
};

/// The wheel odometry of a run, raw and refined by scan matching, beside what a mapper made of it.
struct OdometryComparison {
  std::vector<OdometryErrors> rows;
  std::size_t unmatched_relations = 0;           ///< without a pose near one of their times
  std::array<std::size_t, 5> steps_by_status{};  ///< indexed by MatchedStep::Status
  std::optional<IncrementHonesty> honesty;       ///< none for less than two steps
};

/// Wheels and matched odometry against relations, then against the corrected poses (one per step of
/// the run; over pieces of the way, and as a whole after the best rigid alignment), and the
/// corrected poses against the relations as well. Rows against relations only where there are any.
OdometryComparison compare_odometry(const Run& run, const MetricTrajectory& corrected,
                                    std::span<const Relation> relations,
                                    const OdometryComparisonParams& params = {});

}  // namespace sketchloc
