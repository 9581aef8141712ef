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

#include "apps/localizer_options.hpp"
#include "apps/option_checks.hpp"
#include "apps/output_folder.hpp"
#include "apps/program.hpp"
#include "apps/read_options.hpp"
#include "apps/run_file.hpp"
#include "datasets/io/atomic_file.hpp"
#include "datasets/io/g2o_io.hpp"
#include "datasets/io/labels_io.hpp"
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

/// All that `topology` is tuned by.
struct TopologyCommandParams {
  TopologyParams topology;
  PlaceClassifierParams classifier;  ///< of the kinds of places in a log
};

/// The fields of the topology stand at the top, as they did before there was a classifier.
template <typename Visitor>
void visit_fields(TopologyCommandParams& params, Visitor&& visit) {
  visit_fields(params.topology, visit);
  visit("classifier", params.classifier);
}

/// Odometry that was refined by scans drifts less than wheels do.
TopologyCommandParams defaults_for(const LabelledRunFiles& files) {
  TopologyCommandParams defaults;
  if (!files.log.empty() && files.odometry == OdometrySource::Matched) {
    defaults.topology = matched_topology_params();
  }
  return defaults;
}

void require_inputs(const LabelledRunFiles& files) {
  if (files.log.empty() == files.trajectory.empty()) {
    throw std::invalid_argument(
        "give --trajectory and --labels, or --log: one of the two says where the robot was");
  }
  if (files.log.empty() && files.labels.empty()) {
    throw std::invalid_argument(
        "--labels is missing: a trajectory does not tell the kinds of places; --log does by its "
        "scans");
  }
  if (!files.network.empty() && (files.log.empty() || !files.labels.empty())) {
    throw std::invalid_argument(
        "--network tells labels from the scans of a --log without --labels");
  }
}

TopologyRecord record_of(LabelledRun run) {
  TopologyRecord record;
  record.odometry = std::move(run.odometry);
  record.labels = std::move(run.labels);
  record.reference = std::move(run.reference);
  record.reference_labels = std::move(run.reference_labels);
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

void recover_record(TopologyRecord& record, const std::vector<Scan>& scans,
                    const TopologyParams& params, const TopologyOptions& options) {
  const std::vector<Se2> odom_from_robot = poses_of(record.odometry);
  const Clock::time_point begin = Clock::now();
  if (options.incremental) {
    recover_growing(record, odom_from_robot, params);
  } else {
    record.run = recover_run(odom_from_robot, record.labels, params, options.stage, scans);
  }
  record.seconds = seconds_since(begin);
  record.recovered = at_times_of(record.odometry, record.run.manhattan_from_robot);
}

RunDescription description_of(const TopologyOptions& options, const TopologyCommandParams& params) {
  RunDescription description{.command = "topology",
                             .seed = std::nullopt,
                             .inputs = {{"stage", name_of(stage_names(), options.stage)}},
                             .parameters = to_config(params)};
  const auto add = [&](const char* name, const std::filesystem::path& file) {
    if (!file.empty()) {
      description.inputs.emplace_back(name, file.string());
    }
  };
  add("trajectory", options.files.trajectory);
  add("log", options.files.log);
  if (!options.files.log.empty()) {
    description.inputs.emplace_back("odometry",
                                    name_of(odometry_sources(), options.files.odometry));
  }
  add("labels", options.files.labels);
  add("network", options.files.network);
  add("reference", options.files.reference);
  add("reference-labels", options.files.reference_labels);
  if (options.incremental) {
    description.inputs.emplace_back("incremental", "true");
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
  if (record.reference_labels) {
    text += fmt::format("kinds of places: {:.1f} % right\n",
                        100.0 * label_confusion(record).accuracy());
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
  const auto params = parameters_from(options.parameters, defaults_for(options.files));
  require_inputs(options.files);
  if (options.incremental && options.stage != TopologyStage::Feedback) {
    throw std::invalid_argument(
        "--incremental uses all there is: leave out --stage, or --incremental");
  }
  OutputFolder out(options.out, options.force);
  LabelledRun run = read_labelled_run(options.files, params.classifier);
  const std::vector<Scan> scans = std::move(run.scans);
  TopologyRecord record = record_of(std::move(run));
  recover_record(record, scans, params.topology, options);
  warn_of(record);
  write_tum(out / "trajectory.tum", record.recovered);
  if (options.files.labels.empty()) {
    write_labels(out / "labels.csv", record.labels);
  }
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
  LabelledRunFiles& files = options->files;
  command->add_option("--trajectory", files.trajectory, "Odometry of the run, in metres")
      ->type_name("UNOPT.tum")
      ->group(kAlgorithmGroup);
  command
      ->add_option("--labels", files.labels,
                   "The kind of place of each pose: index,label_name with rackspace, corridor, "
                   "intersection or trisection")
      ->type_name("LABELS.csv")
      ->group(kAlgorithmGroup);
  command
      ->add_option("--log", files.log,
                   "A whole log instead: odometry is refined by its scans, these tell kinds of "
                   "places and close loops")
      ->type_name("LOG")
      ->group(kAlgorithmGroup);
  add_read_options(*command, files.reading);
  add_named_option(*command, "--odometry", files.odometry, odometry_sources(),
                   "Of the log: matched (refined by its scans, the default) or raw")
      ->group(kAlgorithmGroup);
  command
      ->add_option("--network", files.network,
                   "That tells kinds of places from scans; default: the one that comes with the "
                   "program")
      ->type_name("ONNX")
      ->group(kAlgorithmGroup);
  add_named_option(*command, "--stage", options->stage, stage_names(),
                   "How much is used: unoptimised, snap, manhattan, loops, dense, feedback "
                   "(default)")
      ->group(kAlgorithmGroup);
  command
      ->add_flag("--incremental", options->incremental,
                 "Node by node, as if the robot were driving")
      ->group(kAlgorithmGroup);
  add_parameter_options(
      *command, [options] { return to_config(defaults_for(options->files)); }, options->parameters);
  command
      ->add_option("--reference", files.reference,
                   "Where the robot was, pose by pose: errors are taken")
      ->type_name("GT.tum")
      ->group(kOutputGroup);
  command
      ->add_option("--reference-labels", files.reference_labels,
                   "The true kinds of places, pose by pose: errors are counted")
      ->type_name("LABELS.csv")
      ->group(kOutputGroup);
  command
      ->add_option("--out", options->out,
                   "Folder for trajectory.tum, graph.g2o, nodes.csv, pairs.csv, metrics.json, "
                   "picture.png, report.html and run.yaml; of a log also labels.csv")
      ->required()
      ->type_name("DIR")
      ->group(kOutputGroup);
  command->add_flag("--force", options->force, "Replace an earlier result")->group(kOutputGroup);
  command->callback([options] { run_topology(*options); });
}

}  // namespace sketchloc
