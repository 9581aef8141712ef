#include "apps/evaluate_command.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/config.hpp"
#include "apps/evaluate_log.hpp"
#include "apps/evaluate_runs.hpp"
#include "apps/input_checks.hpp"
#include "apps/option_checks.hpp"
#include "apps/output_folder.hpp"
#include "apps/program.hpp"
#include "apps/read_options.hpp"
#include "apps/result_files.hpp"
#include "apps/run_file.hpp"
#include "datasets/io/atomic_file.hpp"
#include "datasets/io/sketch_io.hpp"
#include "datasets/io/trajectory_io.hpp"
#include "eval/run_metrics.hpp"
#include "eval/step_table.hpp"
#include "motion/angles.hpp"
#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

struct EvaluateOptions {
  fs::path trajectory;
  fs::path run;
  fs::path log;
  fs::path map;
  SketchReading drawing;
  fs::path reference;
  std::vector<fs::path> alternatives;
  fs::path relations;
  double max_gap_s = 0.01;
  std::vector<double> deltas_m = {1.0, 5.0, 10.0};
  std::vector<std::size_t> deltas_frames = {1};
  LossDefinition loss;
  bool json = false;
  std::vector<fs::path> runs;
  fs::path against;
  fs::path config;  ///< read before the command line, see apps/recorded_options.hpp
  fs::path out;
  bool force = false;
};

std::string summary_row(const std::string& name, const std::optional<ErrorSummary>& summary) {
  if (!summary) {
    return fmt::format("{:<22}{:>10}\n", name, "-");
  }
  return fmt::format("{:<22}{:>10.3f}{:>10.3f}{:>10.3f}{:>10.3f}{:>10.3f}\n", name, summary->mean,
                     summary->median, summary->rmse, summary->p90, summary->max);
}

std::string rows(const std::string& name, const PoseErrors& errors) {
  const std::optional<ErrorSummary> rotation_deg =
      errors.rotation_rad ? std::optional(scaled(*errors.rotation_rad, deg_from_rad(1.0)))
                          : std::nullopt;
  return summary_row(name + ", m", errors.translation_m) +
         summary_row(name + ", deg", rotation_deg);
}

std::string heading_row() {
  return fmt::format("{:<22}{:>10}{:>10}{:>10}{:>10}{:>10}\n", "", "mean", "median", "rmse", "p90",
                     "max");
}

std::string relative_name(const RelativeErrorParams& params) {
  if (const auto* by_frames = std::get_if<FrameDelta>(&params.delta)) {
    return fmt::format("RPE over {} frames", by_frames->frames);
  }
  return fmt::format("RPE over {:g} m", std::get<PathDelta>(params.delta).path_m);
}

std::vector<RelativeErrorParams> relative_params(const EvaluateOptions& options) {
  std::vector<RelativeErrorParams> params;
  for (const std::size_t frames : options.deltas_frames) {
    params.push_back({.delta = FrameDelta{frames}});
  }
  for (const double path_m : options.deltas_m) {
    params.push_back({.delta = PathDelta{.path_m = path_m}});
  }
  return params;
}

Evaluation evaluate_trajectory(const EvaluateOptions& options) {
  const TrajectoryMetrics metrics =
      measure_trajectory(read_tum(options.reference), read_tum(options.trajectory),
                         options.max_gap_s, relative_params(options));
  if (metrics.matched == 0) {
    throw std::runtime_error(
        fmt::format("{}: the times do not overlap: no pose within {} s of one in {}; check that "
                    "both have the same clock, or "
                    "give a larger --max-gap",
                    options.trajectory.string(), options.max_gap_s, options.reference.string()));
  }
  std::string table =
      fmt::format("{} of {} poses have a reference\n", metrics.matched, metrics.poses) +
      heading_row() + rows("ATE unaligned", metrics.unaligned) +
      rows("ATE first pose", metrics.first_pose) + rows("ATE SE(2)", metrics.se2) +
      rows("ATE Sim(2)", metrics.sim2);
  for (const RelativeErrors& relative : metrics.relative) {
    table += rows(relative_name(relative.params), relative.errors);
  }
  return {.table = table, .json = to_json(metrics)};
}

PictureSize size_of(const Sketch& sketch) {
  return {.width_px = sketch.width_px(), .height_px = sketch.height_px()};
}

std::string text_of(const PictureSize& size) {
  return std::to_string(size.width_px) + " x " + std::to_string(size.height_px) + " px";
}

/// Of the drawing that a run was in: the reference counts its rows from the top.
PictureSize drawing_size(const EvaluateOptions& options) {
  const auto run = read_run_description(options.run / "run.yaml");
  const bool is_known = run && run->drawing;
  if (options.map.empty() && !is_known) {
    throw std::invalid_argument((options.run / "run.yaml").string() +
                                ": does not state the size of the drawing; give --map DRAWING");
  }
  if (options.map.empty()) {
    return *run->drawing;
  }
  const PictureSize given = size_of(read_any_drawing(options.map, options.drawing));
  if (is_known && *run->drawing != given) {
    throw std::invalid_argument(options.map.string() + ": is " + text_of(given) +
                                ", but the run was in a drawing of " + text_of(*run->drawing) +
                                "; leave out --map");
  }
  return given;
}

Reference read_reference_of(const EvaluateOptions& options, const RunRecord& record,
                            int height_px) {
  Reference reference = read_reference(options.reference, height_px);
  std::vector<double> scan_times_s;
  for (const StepReport& report : record.steps) {
    scan_times_s.resize(report.step + 1, std::nan(""));
    scan_times_s.back() = report.time_s;
  }
  if (is_of_another_run(reference, scan_times_s)) {
    throw std::runtime_error(options.reference.string() +
                             ": its times are not those of the run; give the reference of the "
                             "same log");
  }
  for (const std::string& doubt : doubts_about(reference, scan_times_s)) {
    spdlog::warn("{}: {}", options.reference.string(), doubt);
  }
  return reference;
}

Evaluation evaluate_run(const EvaluateOptions& options) {
  const int height_px = drawing_size(options).height_px;
  RunRecord record;
  record.steps = read_step_table(options.run / "trajectory.csv");
  record.reference = read_reference_of(options, record, height_px);
  record.loss = options.loss;
  for (const fs::path& csv : options.alternatives) {
    record.alternatives.push_back(
        as_reference(read_alternative(csv, height_px), *record.reference));
  }
  const RunMetrics metrics = measure_run(record);
  if (metrics.errors->scored == 0) {
    throw std::runtime_error(options.reference.string() +
                             ": has no scored pose for any step of the run");
  }
  const SketchErrors& errors = *metrics.errors;
  return {.table = error_text(errors) + heading_row() +
                   summary_row("position, m", errors.translation_m) +
                   summary_row("position, px", errors.translation_px) +
                   summary_row("heading, deg", scaled(*errors.heading_rad, deg_from_rad(1.0))),
          .json = to_json(metrics)};
}

void check_config(const fs::path& config) {
  const auto earlier = config.empty() ? std::nullopt : read_run_description(config);
  if (!config.empty() && (!earlier || earlier->command != "evaluate")) {
    throw std::invalid_argument(config.string() + ": is not the run.yaml of an earlier evaluation");
  }
}

void check_inputs(const EvaluateOptions& options) {
  const int subjects = (options.trajectory.empty() ? 0 : 1) + (options.run.empty() ? 0 : 1) +
                       (options.log.empty() ? 0 : 1);
  if (subjects != 1) {
    throw std::invalid_argument(
        "evaluate needs one of --trajectory EST.tum, --run DIR, --log LOG and --runs DIR...");
  }
  const bool log_alone = !options.log.empty() && options.map.empty();
  if (log_alone != options.reference.empty()) {
    throw std::invalid_argument(log_alone ? "--log with --reference needs --map DRAWING as well"
                                          : "evaluate needs --reference REF.tum|REF.csv");
  }
  if (!log_alone && !options.relations.empty()) {
    throw std::invalid_argument("--relations belong to --log without --map");
  }
}

/// Everything that was given and that the result depends on.
RunDescription description_of(const EvaluateOptions& options) {
  RunDescription description{
      .command = "evaluate", .seed = {}, .inputs = {}, .parameters = {.is_map = true}};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) {
      description.inputs.emplace_back(option, value);
    }
  };
  add("reference", options.reference.string());
  add("trajectory", options.trajectory.string());
  add("run", options.run.string());
  add("log", options.log.string());
  add("map", options.map.string());
  for (const auto& [option, value] : given_drawing_options(options.drawing)) {
    description.inputs.emplace_back(option, value);
  }
  add("relations", options.relations.string());
  for (const fs::path& csv : options.alternatives) {
    add("alternative", csv.string());
  }
  add("max-gap", number_text(options.max_gap_s));
  for (const double path_m : options.deltas_m) {
    add("delta-m", number_text(path_m));
  }
  for (const std::size_t frames : options.deltas_frames) {
    add("delta-frames", number_text(frames));
  }
  add("lost-beyond", number_text(options.loss.bound_m));
  return description;
}

Evaluation evaluate(const EvaluateOptions& options) {
  if (!options.run.empty()) {
    return evaluate_run(options);
  }
  if (!options.trajectory.empty()) {
    return evaluate_trajectory(options);
  }
  if (!options.map.empty()) {
    return evaluate_scans(options.log, read_any_drawing(options.map, options.drawing),
                          options.reference);
  }
  return evaluate_odometry(options.log, options.relations, {.max_gap_s = options.max_gap_s});
}

void print_runs(const EvaluateOptions& options) {
  const bool alone = options.trajectory.empty() && options.run.empty() && options.log.empty() &&
                     options.reference.empty() && options.out.empty() && !options.json;
  if (!alone) {
    throw std::invalid_argument("--runs prints a table and goes with --against only");
  }
  std::cout << runs_table(options.runs,
                          options.against.empty() ? std::nullopt : std::optional(options.against));
}

void run_evaluate(const EvaluateOptions& options) {
  check_config(options.config);
  if (!options.runs.empty()) {
    print_runs(options);
    return;
  }
  check_inputs(options);
  validate(options.loss);
  const Evaluation found = evaluate(options);
  if (!options.out.empty()) {
    OutputFolder out(options.out, options.force);
    write_atomically(out / "metrics.json", found.json);
    write_atomically(out / "run.yaml", run_file_text(description_of(options)));
    out.commit();
  }
  std::cout << (options.json ? found.json : found.table);
}

void add_algorithm_options(CLI::App& command, EvaluateOptions& options) {
  const auto option = [&](const std::string& flag, auto& value, const std::string& help) {
    return command.add_option(flag, value, help)->group(kAlgorithmGroup);
  };
  option("--config", options.config, "run.yaml of an earlier evaluation, to repeat it")
      ->type_name("FILE");
  option("--trajectory", options.trajectory, "A metric trajectory")->type_name("EST.tum");
  option("--run", options.run, "Or a folder that localize wrote")->type_name("DIR");
  option("--log", options.log,
         "Or a log that a mapper corrected: its odometry, raw and matched; with --map and "
         "--reference: its scans in the drawing")
      ->type_name("LOG");
  option("--reference", options.reference,
         "What to compare with: a trajectory, or the poses in the drawing")
      ->type_name("REF.tum|REF.csv");
  option("--map", options.map, "The drawing of --log; of --run only where its run.yaml lacks it")
      ->type_name("DRAWING");
  add_drawing_options(command, options.drawing, "Of the drawing");
  option("--alternative", options.alternatives,
         "Another reading of the drawing that counts as right too")
      ->type_name("ALT.csv");
  option("--relations", options.relations, "Relative poses of --log that people checked")
      ->type_name("RELATIONS");
  option("--runs", options.runs,
         "Or a table of many runs: folders that hold one folder per seed, a line each")
      ->type_name("DIR");
  option("--against", options.against,
         "Of --runs: print the paired differences to this folder's runs too")
      ->type_name("DIR");
  option("--max-gap", options.max_gap_s, "Between the times of two poses of a pair, s")
      ->check(non_negative_number())
      ->capture_default_str();
  option("--delta-m", options.deltas_m, "Ways for the relative error, m")
      ->check(positive_number())
      ->capture_default_str();
  option("--delta-frames", options.deltas_frames, "Numbers of poses for the relative error")
      ->check(whole_number())
      ->check(positive_number())
      ->capture_default_str();
  option("--lost-beyond", options.loss.bound_m, "Error that counts as lost, m")
      ->check(positive_number())
      ->capture_default_str();
}

void add_output_options(CLI::App& command, EvaluateOptions& options) {
  command.add_flag("--json", options.json, "Print metrics.json instead of a table")
      ->group(kOutputGroup);
  command.add_option("--out", options.out, "Folder for metrics.json and run.yaml")
      ->group(kOutputGroup)
      ->type_name("DIR");
  command.add_flag("--force", options.force, "Replace an earlier result")->group(kOutputGroup);
}

}  // namespace

void add_evaluate_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "evaluate",
      "Compare a trajectory, a run in a drawing, or the odometry and scans of a log with a "
      "reference; or sum up many runs.");
  auto options = std::make_shared<EvaluateOptions>();
  add_algorithm_options(*command, *options);
  add_output_options(*command, *options);
  command->callback([options] { run_evaluate(*options); });
}

}  // namespace sketchloc
