#include "eval/topology_suite.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "datasets/sim/odometry_model.hpp"
#include "motion/validate.hpp"
#include "topology/growing_run.hpp"

namespace sketchloc {
namespace {

constexpr const char* kStages = "stages";
constexpr const char* kWrongPairs = "wrong pairs";
constexpr const char* kWrongLabels = "wrong labels";
constexpr const char* kOdometry = "odometry";
constexpr const char* kIncremental = "incremental";
constexpr std::string_view kSiamese = "siamese ";
constexpr const char* kLog = "log";
constexpr std::array kLogRows = {"matched odometry", "matched, true labels", "matched, by scans",
                                 "raw odometry",     "raw, true labels",     "raw, by scans"};
/// Wrong labels come in runs, as those of a classifier do.
constexpr std::size_t kWrongRun = 8;

std::size_t random_index(std::size_t count, Rng& rng) {
  return static_cast<std::size_t>(uniform(0.0, static_cast<double>(count), rng));
}

RecoveredRun recover_growing(const std::vector<Se2>& poses, const std::vector<PlaceLabel>& labels,
                             const TopologyParams& params) {
  GrowingRun growing(params);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    growing.add(poses[i], labels[i]);
    if (growing.way_since_update_m() >= params.update_m) {
      growing.update();
    }
  }
  return growing.update();
}

TopologyStage stage_of(const std::string& name) {
  const auto names = names_of(TopologyStage{});
  return std::ranges::find(names, name, &std::pair<std::string_view, TopologyStage>::first)->second;
}

KernelShape kernel_of(const std::string& name) {
  const auto names = names_of(KernelShape{});
  return std::ranges::find(names, name, &std::pair<std::string_view, KernelShape>::first)->second;
}

std::vector<PlaceLabel> with_wrong_labels(std::vector<PlaceLabel> labels, double share, Rng& rng) {
  const auto wrong = static_cast<std::size_t>(share * static_cast<double>(labels.size()));
  std::vector<bool> changed(labels.size(), false);
  for (std::size_t count = 0; count < wrong;) {
    const std::size_t first = random_index(labels.size(), rng);
    const auto other = static_cast<PlaceLabel>(random_index(names_of(PlaceLabel{}).size(), rng));
    for (std::size_t i = first; i < std::min(first + kWrongRun, labels.size()); ++i) {
      if (!changed[i] && labels[i] != other && count < wrong) {
        labels[i] = other;
        changed[i] = true;
        ++count;
      }
    }
  }
  return labels;
}

/// Two nodes of one label far apart, tied together as if they were one place.
SamePlacePair wrong_pair(const RecoveredRun& run, Rng& rng) {
  constexpr double kFar_m = 2.0;
  constexpr int kTries = 1000;
  SamePlacePair pair;
  for (int i = 0; i < kTries; ++i) {
    pair.earlier = random_index(run.nodes.size(), rng);
    pair.later = random_index(run.nodes.size(), rng);
    const TopologicalNode& a = run.nodes[pair.earlier];
    const TopologicalNode& b = run.nodes[pair.later];
    const Eigen::Vector2d apart = run.manhattan_from_robot[a.first].translation() -
                                  run.manhattan_from_robot[b.first].translation();
    if (a.label == b.label && apart.norm() > kFar_m) {
      const std::size_t steps = std::min(a.last - a.first, b.last - b.first);
      for (std::size_t k = 0; k <= steps; k += 5) {
        pair.beside.push_back({.earlier = a.first + k, .later = b.first + k});
      }
      return pair;
    }
  }
  return pair;
}

/// The run with so many wrong pairs that they are this share of all, optimized behind a kernel
/// from where the headings alone put it.
RecoveredRun with_wrong_pairs(RecoveredRun run, const std::vector<Se2>& poses,
                              const TopologyParams& params, double share, Rng& rng) {
  const auto wrong = static_cast<std::size_t>(
      std::llround(share / (1.0 - share) * static_cast<double>(run.pairs.size())));
  PoseGraph graph = run_graph(poses, run.evidence, params.graph);
  for (const SamePlacePair& pair : run.pairs) {
    tie_together(graph, pair, params.graph);
  }
  for (std::size_t i = 0; i < wrong; ++i) {
    const SamePlacePair pair = wrong_pair(run, rng);
    if (!pair.beside.empty()) {
      tie_together(graph, pair, params.graph);
    }
  }
  run.result = optimise(graph, {.kernel = params.kernel, .initial = GraphStart::Given});
  for (std::size_t i = 0; i < run.manhattan_from_robot.size(); ++i) {
    run.manhattan_from_robot[i] = to_se2(run.result.poses[i]);
  }
  return run;
}

std::vector<Se2> simulated_odometry(const std::vector<Se2>& reference, Rng& rng) {
  const OdometrySimulator simulator({}, rng);
  std::vector<Se2> odometry = {reference.front()};
  for (std::size_t i = 0; i + 1 < reference.size(); ++i) {
    odometry.push_back(odometry.back() *
                       simulator.measured(reference[i].inverse() * reference[i + 1], rng));
  }
  return odometry;
}

/// What scans bring to the recovery of a log: labels and closures; or true labels alone.
RecoveredRun recovered_log(const std::string& row, const TopologySet& set,
                           const TopologyParams& params) {
  const bool raw = row.starts_with("raw");
  const bool by_scans = row.ends_with("by scans");
  const bool optimised = by_scans || row.ends_with("true labels");
  return recover_run(raw ? set.log->raw : poses_of(set.odometry),
                     by_scans ? set.log->told : set.labels,
                     raw ? params : matched_topology_params(),
                     optimised ? TopologyStage::Feedback : TopologyStage::Unoptimised,
                     by_scans ? std::span<const Scan>(set.log->scans) : std::span<const Scan>());
}

ConfusionMatrix told_of_true(const TopologySet& set) {
  ConfusionMatrix confusion(names_of(PlaceLabel{}).size());
  for (std::size_t i = 0; i < set.labels.size(); ++i) {
    confusion.add(static_cast<std::size_t>(set.labels[i]),
                  static_cast<std::size_t>(set.log->told[i]));
  }
  return confusion;
}

RecoveredRun recovered_by(const TopologyTask& task, const TopologySet& set, TopologyParams params,
                          Rng& rng) {
  if (task.part == kLog) {
    return recovered_log(task.row, set, params);
  }
  const std::vector<Se2> poses = poses_of(set.odometry);
  if (task.part == kWrongLabels) {
    return recover_run(poses, with_wrong_labels(set.labels, task.level, rng), params);
  }
  if (task.part == kWrongPairs) {
    RecoveredRun run = recover_run(poses, set.labels, params);
    params.kernel.shape = kernel_of(task.row);
    return with_wrong_pairs(std::move(run), poses, params, task.level, rng);
  }
  if (task.part == kOdometry) {
    return recover_run(simulated_odometry(poses_of(set.reference), rng), set.labels, params,
                       stage_of(task.row));
  }
  if (task.row == kIncremental) {
    return recover_growing(poses, set.labels, params);
  }
  if (task.row.starts_with(kSiamese)) {
    params.same_place.comparison = PlaceComparison::Siamese;
    return recover_run(poses, set.labels, params, stage_of(task.row.substr(kSiamese.size())));
  }
  return recover_run(poses, set.labels, params, stage_of(task.row));
}

void add_seeds(std::vector<TopologyTask>& tasks, TopologyTask task, int seeds) {
  for (int seed = 1; seed <= seeds; ++seed) {
    task.seed = static_cast<std::uint64_t>(seed);
    tasks.push_back(task);
  }
}

}  // namespace

void validate(const TopologySuiteParams& params) {
  require_in_range("most_wrong_pairs", params.most_wrong_pairs, 0.0, 0.9);
  require_in_range("most_wrong_labels", params.most_wrong_labels, 0.0, 1.0);
}

std::vector<TopologyTask> topology_tasks(std::span<const TopologySet> sets,
                                         const TopologySuiteParams& params, int seeds) {
  validate(params);
  constexpr std::array kLevels = {0.0, 0.2, 0.6, 1.0};  // of the most that is wrong
  std::vector<TopologyTask> tasks;
  for (std::size_t set = 0; set < sets.size(); ++set) {
    if (sets[set].log) {
      for (const char* row : kLogRows) {
        tasks.push_back({.part = kLog, .row = row, .set = set});
      }
      continue;
    }
    for (const auto& [name, stage] : names_of(TopologyStage{})) {
      tasks.push_back({.part = kStages, .row = std::string(name), .set = set});
    }
    tasks.push_back({.part = kStages, .row = kIncremental, .set = set});
    for (const char* stage : {"loops", "dense", "feedback"}) {
      tasks.push_back({.part = kStages, .row = std::string(kSiamese) + stage, .set = set});
    }
    for (const char* kernel : {"none", "huber", "cauchy", "dcs", "graduated"}) {
      for (const double level : kLevels) {
        add_seeds(tasks,
                  {.part = kWrongPairs,
                   .row = kernel,
                   .level = level * params.most_wrong_pairs,
                   .set = set},
                  seeds);
      }
    }
    for (const double level : {0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0}) {
      add_seeds(tasks,
                {.part = kWrongLabels,
                 .row = "feedback",
                 .level = level * params.most_wrong_labels,
                 .set = set},
                seeds);
    }
    for (const char* stage : {"unoptimised", "snap", "manhattan", "feedback"}) {
      add_seeds(tasks, {.part = kOdometry, .row = stage, .set = set}, seeds);
    }
  }
  return tasks;
}

TopologyTrial run_task(const TopologyTask& task, std::span<const TopologySet> sets,
                       const TopologyParams& params, std::uint64_t seed) {
  const TopologySet& set = sets[task.set];
  Rng rng = make_rng(seed, task.seed, task.set);
  const RecoveredRun run = recovered_by(task, set, params, rng);
  MetricTrajectory recovered;
  for (std::size_t i = 0; i < run.manhattan_from_robot.size(); ++i) {
    recovered.append(set.reference[i].time_s, run.manhattan_from_robot[i]);
  }
  const bool told = task.part == kLog && task.row.ends_with("by scans");
  return {.part = task.part,
          .row = task.row,
          .level = task.level,
          .set = set.name,
          .seed = task.seed,
          .errors = metric_errors(set.reference, recovered),
          .pairs = count_pairs(run, poses_of(set.reference)),
          .labels = told ? std::optional(told_of_true(set)) : std::nullopt};
}

}  // namespace sketchloc
