#include "apps/topology_command.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "apps/labelled_run.hpp"
#include "apps/option_checks.hpp"
#include "apps/output_folder.hpp"
#include "apps/program.hpp"
#include "apps/run_file.hpp"
#include "datasets/io/atomic_file.hpp"
#include "datasets/io/g2o_io.hpp"
#include "datasets/io/trajectory_io.hpp"
#include "eval/topology_record.hpp"
#include "topology/growing_run.hpp"

namespace sketchloc {
namespace {

const std::map<std::string, TopologyStage>& stage_names() {
  static const std::map<std::string, TopologyStage> kNames = [] {
    std::map<std::string, TopologyStage> names;
    for (const auto& [name, stage] : names_of(TopologyStage{})) {
      names.emplace(name, stage);
    }
    return names;
  }();
  return kNames;
}

TopologyRecord read_record(const TopologyOptions& options) {
  LabelledRun run = read_labelled_run(
      {.trajectory = options.trajectory, .labels = options.labels, .reference = options.reference});
  TopologyRecord record;
  record.odometry = std::move(run.odometry);
  record.labels = std::move(run.labels);
  record.reference = std::move(run.reference);
  return record;
}

MetricTrajectory at_times_of(const MetricTrajectory& times, const std::vector<Se2>& poses) {
  std::vector<Stamped<Se2>> stamped;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    stamped.push_back({times[i].time_s, poses[i]});
  }
  return MetricTrajectory(std::move(stamped));
}

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// As if the robot were driving.
void recover_growing(TopologyRecord& record, const std::vector<Se2>& odom_from_robot,
                     const TopologyParams& params) {
  GrowingRun growing(params);
  TopologyRecord::Growing& told = record.growing.emplace();
  std::vector<Se2> online;
  for (std::size_t i = 0; i < odom_from_robot.size(); ++i) {
    growing.add(odom_from_robot[i], record.labels[i]);
    const bool is_last = i + 1 == odom_from_robot.size();
    if (is_last || growing.way_since_update_m() >= params.update_m) {
      const Clock::time_point begin = Clock::now();
      const RecoveredRun& run = growing.update();
      told.worst_update_s = std::max(told.worst_update_s, seconds_since(begin));
      ++told.updates;
      if (is_last) {
        record.run = run;
      }
    }
    online.push_back(growing.manhattan_from_robot());
  }
  told.online = at_times_of(record.odometry, online);
}

void recover_record(TopologyRecord& record, const TopologyParams& params,
                    const TopologyOptions& options) {
  std::vector<Se2> odom_from_robot;
  for (const Stamped<Se2>& stamped : record.odometry) {
    odom_from_robot.push_back(stamped.pose);
  }
  const Clock::time_point begin = Clock::now();
  if (options.incremental) {
    recover_growing(record, odom_from_robot, params);
  } else {
    record.run = recover_run(odom_from_robot, record.labels, params, options.stage);
  }
  record.seconds = seconds_since(begin);
  record.recovered = at_times_of(record.odometry, record.run.manhattan_from_robot);
}

RunDescription description_of(const TopologyOptions& options, const TopologyParams& params) {
  RunDescription description{.command = "topology",
                             .seed = std::nullopt,
                             .inputs = {{"trajectory", options.trajectory.string()},
                                        {"labels", options.labels.string()},
                                        {"stage", name_of(stage_names(), options.stage)}},
                             .parameters = to_config(params)};
  if (options.incremental) {
    description.inputs.emplace_back("incremental", "true");
  }
  if (!options.reference.empty()) {
    description.inputs.emplace_back("reference", options.reference.string());
  }
  return description;
}

std::string summary_text(const TopologyRecord& record) {
  const RecoveredRun& run = record.run;
  std::string text = fmt::format(
      "{} poses, {} straight pieces, {} nodes, {} pairs taken for one place\n",
      record.odometry.size(), run.evidence.pieces.size(), run.nodes.size(), run.pairs.size());
  if (record.reference) {
    const MetricErrors before = metric_errors(*record.reference, record.odometry);
    const MetricErrors after = metric_errors(*record.reference, record.recovered);
    text += fmt::format(
        "from the reference, m:   odometry  recovered\n"
        "  as it is, mean         {:8.2f}   {:8.2f}\n"
        "  first pose, mean       {:8.2f}   {:8.2f}\n"
        "  laid onto it, RMSE     {:8.2f}   {:8.2f}\n",
        before.unaligned.mean, after.unaligned.mean, before.first_pose.mean, after.first_pose.mean,
        before.se2.rmse, after.se2.rmse);
  }
  return text + fmt::format("{:.2f} s\n", record.seconds);
}

void warn_of(const TopologyRecord& record) {
  if (record.run.evidence.pieces.empty()) {
    spdlog::warn(
        "the robot never drove straight on, so nothing tells the walls' directions: the odometry "
        "is kept; see --straight.most_turn_deg");
  }
}

}  // namespace

void run_topology(const TopologyOptions& options) {
  const auto params = parameters_from<TopologyParams>(options.parameters);
  if (options.incremental && options.stage != TopologyStage::Feedback) {
    throw std::invalid_argument(
        "--incremental uses all there is: leave out --stage, or --incremental");
  }
  OutputFolder out(options.out, options.force);
  TopologyRecord record = read_record(options);
  recover_record(record, params, options);
  warn_of(record);
  write_tum(out / "trajectory.tum", record.recovered);
  write_g2o(out / "graph.g2o", record.run.graph);
  write_atomically(out / "nodes.csv", nodes_csv(record));
  write_atomically(out / "pairs.csv", pairs_csv(record));
  write_atomically(out / "metrics.json", to_json(record));
  write_atomically(out / "picture.png", picture_png(record));
  write_atomically(out / "report.html", report_html(record));
  write_atomically(out / "run.yaml", run_file_text(description_of(options, params)));
  out.commit();
  std::cout << summary_text(record) << "report: " << (out.target() / "report.html").string()
            << "\n";
}

void add_topology_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "topology", "Recover a run in a building of right angles from the kinds of its places.");
  const auto options = std::make_shared<TopologyOptions>();
  command->add_option("--trajectory", options->trajectory, "Odometry of the run, in metres")
      ->required()
      ->type_name("UNOPT.tum")
      ->group(kAlgorithmGroup);
  command
      ->add_option("--labels", options->labels,
                   "The kind of place of each pose: index,label_name with rackspace, corridor, "
                   "intersection or trisection")
      ->required()
      ->type_name("LABELS.csv")
      ->group(kAlgorithmGroup);
  add_named_option(*command, "--stage", options->stage, stage_names(),
                   "How much is used: unoptimised, snap, manhattan, loops, dense, feedback "
                   "(default)")
      ->group(kAlgorithmGroup);
  command
      ->add_flag("--incremental", options->incremental,
                 "Node by node, as if the robot were driving")
      ->group(kAlgorithmGroup);
  add_parameter_options(*command, to_config(TopologyParams{}), options->parameters);
  command
      ->add_option("--reference", options->reference,
                   "Where the robot was, pose by pose: errors are taken")
      ->type_name("GT.tum")
      ->group(kOutputGroup);
  command
      ->add_option("--out", options->out,
                   "Folder for trajectory.tum, graph.g2o, nodes.csv, pairs.csv, metrics.json, "
                   "picture.png, report.html and run.yaml")
      ->required()
      ->type_name("DIR")
      ->group(kOutputGroup);
  command->add_flag("--force", options->force, "Replace an earlier result")->group(kOutputGroup);
  command->callback([options] { run_topology(*options); });
}

}  // namespace sketchloc
