#include "eval/odometry_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "eval/distributions.hpp"
#include "motion/check.hpp"
#include "registration/matched_odometry.hpp"

namespace sketchloc {
namespace {

constexpr std::array kWays_m = {1.0, 5.0, 10.0};
constexpr double kDegrees = 3.0;  ///< of freedom, of an increment

/// A trajectory at the times of the corrected poses.
struct NamedTrajectory {
  std::string name;
  MetricTrajectory trajectory;
};

struct MatchedRun {
  MetricTrajectory trajectory;
  std::vector<UncertainIncrement> increments;
  std::array<std::size_t, 5> steps_by_status{};
};

std::string text_of(const std::string& before, double value, const std::string& after) {
  std::ostringstream text;
  text << before << value << after;
  return text.str();
}

MetricTrajectory wheels_of(const Run& run) {
  MetricTrajectory trajectory;
  for (const RunStep& step : run.steps) {
    trajectory.append(step.scan.time_s, step.odom_from_robot);
  }
  return trajectory;
}

MatchedRun match_scans(const Run& run) {
  MatchedOdometry matcher;
  MatchedRun result;
  for (const RunStep& step : run.steps) {
    const MatchedStep matched = matcher.step(step.scan, step.odom_from_robot);
    result.trajectory.append(step.scan.time_s, matched.odom_from_robot);
    result.increments.push_back({matched.previous_from_robot, matched.covariance});
    ++result.steps_by_status[static_cast<std::size_t>(matched.status)];
  }
  return result;
}

/// Relations of one kind.
struct RelationGroup {
  std::string name;
  std::vector<Relation> relations;
};

std::array<RelationGroup, 3> groups_of(std::span<const Relation> relations,
                                       double long_relation_s) {
  std::array<RelationGroup, 3> groups = {
      RelationGroup{text_of("relations up to ", long_relation_s, " s"), {}},
      RelationGroup{text_of("relations over ", long_relation_s, " s"), {}},
      RelationGroup{"all relations", {relations.begin(), relations.end()}}};
  for (const Relation& relation : relations) {
    const double duration_s = std::abs(relation.second_time_s - relation.first_time_s);
    groups[duration_s > long_relation_s ? 1 : 0].relations.push_back(relation);
  }
  return groups;
}

/// Rows against the relations, short and long ones apart and together.
void compare_with_relations(std::span<const NamedTrajectory> trajectories,
                            std::span<const Relation> relations,
                            const OdometryComparisonParams& params, OdometryComparison& result) {
  for (const auto& [group, members] : groups_of(relations, params.long_relation_s)) {
    for (const auto& [name, trajectory] : trajectories) {
      const RelationErrors found = relation_errors(trajectory, members, params.max_gap_s);
      result.rows.push_back({name, group, found.errors});
      result.unmatched_relations = std::max(result.unmatched_relations, found.unmatched);
    }
  }
}

/// Rows over pieces of the way, and as a whole.
void compare_with_corrected(std::span<const NamedTrajectory> trajectories,
                            const std::vector<Se2>& world_from_robot, OdometryComparison& result) {
  for (const double way_m : kWays_m) {
    for (const auto& [name, trajectory] : trajectories) {
      result.rows.push_back({name, text_of("corrected poses, over ", way_m, " m"),
                             drift_over_way({world_from_robot, poses_of(trajectory)}, way_m)});
    }
  }
  for (const auto& [name, trajectory] : trajectories) {
    const auto aligned = align({world_from_robot, poses_of(trajectory)}, Alignment::Se2);
    result.rows.push_back(
        {name, "corrected poses, whole log", aligned ? absolute_errors(*aligned) : PoseErrors{}});
  }
}

std::optional<IncrementHonesty> honesty_of(const std::vector<Se2>& world_from_robot,
                                           const std::vector<UncertainIncrement>& increments,
                                           const OdometryComparisonParams& params) {
  const std::vector<double> values = increment_nees(
      world_from_robot, increments,
      {params.reference_sigma_m, params.reference_sigma_m, params.reference_sigma_rad});
  if (values.empty()) {
    return std::nullopt;
  }
  return IncrementHonesty{.median_nees = quantile(values, 0.5),
                          .p90_nees = quantile(values, 0.9),
                          .share_in_95 = share_within(values, chi_square_quantile(0.95, kDegrees))};
}

}  // namespace

OdometryComparison compare_odometry(const Run& run, const MetricTrajectory& corrected,
                                    std::span<const Relation> relations,
                                    const OdometryComparisonParams& params) {
  check(run.steps.size() == corrected.size(), "one corrected pose per step");
  MatchedRun matched = match_scans(run);
  OdometryComparison result;
  result.steps_by_status = matched.steps_by_status;
  const std::array<NamedTrajectory, 3> trajectories = {
      NamedTrajectory{"wheels", wheels_of(run)},
      NamedTrajectory{"matched", std::move(matched.trajectory)},
      NamedTrajectory{"corrected", corrected}};
  if (!relations.empty()) {
    compare_with_relations(trajectories, relations, params, result);
  }
  const std::vector<Se2> world_from_robot = poses_of(corrected);
  compare_with_corrected(std::span(trajectories).first(2), world_from_robot, result);
  result.honesty = honesty_of(world_from_robot, matched.increments, params);
  return result;
}

}  // namespace sketchloc
