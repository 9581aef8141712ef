#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "eval/summary.hpp"
#include "eval/trajectory_errors.hpp"
#include "motion/trajectory.hpp"
#include "topology/confusion_matrix.hpp"
#include "topology/recovered_run.hpp"

namespace sketchloc {

/// Distances from a reference, with the estimate's frame laid onto it in three ways.
struct MetricErrors {
  ErrorSummary unaligned;
  ErrorSummary first_pose;  ///< first poses coincide
  ErrorSummary se2;         ///< least squares, rigid
};

/// Throws std::invalid_argument where no two poses have the same time.
MetricErrors metric_errors(const MetricTrajectory& reference, const MetricTrajectory& estimate);

/// How many of the pairs that were used are the same place by the reference, and how many there
/// are. [Topo20]'s rule: half of the poses of one node lie within `near_m` of the other.
struct PairCounts {
  std::size_t used = 0;
  std::size_t right = 0;  ///< of those used
  std::size_t all = 0;    ///< that are the same place, of one label
};
PairCounts count_pairs(const RecoveredRun& run, std::span<const Se2> world_from_robot,
                       double near_m = 1.0);

/// A run that was recovered by its topology.
struct TopologyRecord {
  MetricTrajectory odometry = {};
  std::vector<PlaceLabel> labels = {};
  RecoveredRun run = {};
  MetricTrajectory recovered = {};
  std::optional<MetricTrajectory> reference = {};                ///< as long as the odometry
  std::optional<std::vector<PlaceLabel>> reference_labels = {};  ///< the true ones, as many
  /// How the run was recovered while it grew; none: at once.
  struct Growing {
    MetricTrajectory online = {};  ///< where the robot was thought to be when it was there
    std::size_t updates = 0;
    double worst_update_s = 0.0;  ///< wall clock
  };
  std::optional<Growing> growing = {};
  double seconds = 0.0;  ///< wall clock, without reading and writing
};

/// How often which PlaceLabel was used where which one is true. There are reference labels.
ConfusionMatrix label_confusion(const TopologyRecord& record);

/// `metrics.json`, see docs/formats.md.
std::string to_json(const TopologyRecord& record);

/// `nodes.csv`: the Manhattan graph, node by node.
std::string nodes_csv(const TopologyRecord& record);
/// `pairs.csv`: the nodes that were taken for one place.
std::string pairs_csv(const TopologyRecord& record);

/// `report.html`: a page of its own.
std::string report_html(const TopologyRecord& record);

/// `picture.png`: odometry, Manhattan graph and recovered run, coloured by label.
std::string picture_png(const TopologyRecord& record);

}  // namespace sketchloc
