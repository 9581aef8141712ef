#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "eval/topology_record.hpp"

namespace sketchloc {

/// A run with a reference, as long as the odometry.
struct TopologySet {
  std::string name;                     ///< runs of one name share a row
  MetricTrajectory odometry = {};       ///< of a log: refined by its scans
  std::vector<PlaceLabel> labels = {};  ///< of a log: the true ones
  MetricTrajectory reference = {};
  /// What a log knows beside; none: a trajectory.
  struct Log {
    std::vector<Scan> scans = {};
    std::vector<PlaceLabel> told = {};  ///< kinds of places, by what was scanned
    std::vector<Se2> raw = {};          ///< odometry as the wheels measured it
  };
  std::optional<Log> log = {};
};

/// What the topology suite tries beside the stages.
struct TopologySuiteParams {
  double most_wrong_pairs = 0.5;   ///< of all pairs, in five steps from none, 0 to 0.9
  double most_wrong_labels = 0.3;  ///< of all poses, in steps of a tenth, 0 to 1
};
void validate(const TopologySuiteParams& params);

template <typename Visitor>
void visit_fields(TopologySuiteParams& params, Visitor&& visit) {
  visit("most_wrong_pairs", params.most_wrong_pairs);
  visit("most_wrong_labels", params.most_wrong_labels);
}

/// One recovery of one run.
struct TopologyTrial {
  /// stages: as recorded, row by row of [Topo20, Table IV]; wrong pairs: pairs of places that are
  /// not the same among the edges; wrong labels; odometry: made anew from the reference; log: what
  /// scans bring.
  std::string part;
  std::string row;     ///< what was done: a stage, a kernel
  double level = 0.0;  ///< share of what is wrong
  std::string set;
  std::uint64_t seed = 0;
  MetricErrors errors;
  PairCounts pairs;
  std::optional<ConfusionMatrix> labels = {};  ///< where scans told the kinds of places
};

/// One piece of the suite; pieces may run in any order.
struct TopologyTask {
  std::string part;
  std::string row;  ///< with "siamese " before a stage: pairs are told by the comparator
  double level = 0.0;
  std::size_t set = 0;
  std::uint64_t seed = 0;
};

/// All pieces. Trajectories: stages once for each, the other parts with seeds 1 ... `seeds`; logs:
/// the part `log`, once.
std::vector<TopologyTask> topology_tasks(std::span<const TopologySet> sets,
                                         const TopologySuiteParams& params, int seeds);

TopologyTrial run_task(const TopologyTask& task, std::span<const TopologySet> sets,
                       const TopologyParams& params, std::uint64_t seed);

/// `metrics.json`, tables for a document, and a page.
std::string topology_suite_json(std::span<const TopologyTrial> trials);
std::string topology_suite_markdown(std::span<const TopologyTrial> trials);
std::string topology_suite_html(std::span<const TopologyTrial> trials);
std::string topology_trials_csv(std::span<const TopologyTrial> trials);

}  // namespace sketchloc
