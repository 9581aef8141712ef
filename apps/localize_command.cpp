#include "apps/localize_command.hpp"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <utility>

#include "apps/given_network.hpp"
#include "apps/input_checks.hpp"
#include "apps/inputs.hpp"
#include "apps/memory.hpp"
#include "apps/option_checks.hpp"
#include "apps/output_folder.hpp"
#include "apps/parallel.hpp"
#include "apps/program.hpp"
#include "apps/progress.hpp"
#include "apps/read_options.hpp"
#include "apps/result_files.hpp"
#include "apps/smooth_run.hpp"
#include "apps/start_pose.hpp"
#include "apps/version.hpp"
#include "datasets/io/reference_io.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_io.hpp"

namespace sketchloc {
namespace {

void check_starts(const LocalizeOptions& options, const LocalizationMethod& method) {
  const StartOptions& start = options.start;
  if ((start.pose.empty() ? 0 : 1) + (start.from_reference ? 1 : 0) + (start.anywhere ? 1 : 0) >
      1) {
    throw std::invalid_argument(
        "give one of --start, --start-from-reference and --global, not several");
  }
  if (start.from_reference && options.reference.empty()) {
    throw std::invalid_argument("--start-from-reference needs --reference REF.csv");
  }
  if (!start.has_pose() && method.method != Method::Mcl) {
    throw std::invalid_argument("--method " + method.name +
                                " needs --start or --start-from-reference");
  }
}

void check_smoothing(const LocalizeOptions& options, const LocalizationMethod& method) {
  if (options.smoothing != Smoothing::None &&
      !(method.method == Method::Mcl && method.registration)) {
    throw std::invalid_argument(
        "--smooth and --lag need a filter with registrations; give --method ours");
  }
}

/// Reads all inputs into the record of the run.
RunRecord read_inputs(const LocalizeOptions& options) {
  RunRecord record;
  record.seed = options.method.seed;
  record.commit = std::string(commit());
  record.sketch = read_drawing_input(options.map, options.drawing);
  record.run = read_log_input(options.log, options.reading);
  if (!options.reference.empty()) {
    record.reference = read_reference_input(options.reference, record.sketch.height_px(),
                                            {record.run, options.log});
    warn_of(options.reference, doubts_about(*record.reference, scan_times_s(record.run)));
    for (const std::filesystem::path& csv : options.alternatives) {
      record.alternatives.push_back(
          as_reference(read_alternative(csv, record.sketch.height_px()), *record.reference));
    }
  }
  return record;
}

/// Where the run starts; none: anywhere.
std::optional<Sim2> start_of(const LocalizeOptions& options, const RunRecord& record) {
  if (!options.start.pose.empty()) {
    return pose_in_drawing(options.start.pose, "--start", {record.sketch, options.map},
                           record.run.steps.front().scan);
  }
  if (!options.start.from_reference) {
    return std::nullopt;
  }
  const auto& poses = record.reference->poses;
  if (poses.empty() || poses.front().step != 0) {
    throw std::runtime_error(options.reference.string() +
                             ": has no pose for the first scan, so --start-from-reference cannot "
                             "use it; give --start");
  }
  return poses.front().sketch_from_robot;
}

void require_done(Localization::Status status, const LocalizeOptions& options) {
  switch (status) {
    case Localization::Status::Done:
      return;
    case Localization::Status::EmptyRun:
      throw std::runtime_error(options.log.string() + ": has no scans");
    case Localization::Status::NoFreeSpace:
      throw std::runtime_error(options.map.string() +
                               ": encloses no free space to start in; give --start");
    case Localization::Status::NoReturns:
      throw std::runtime_error(options.log.string() +
                               ": no scan has a return, so that nothing tells the drawing's scale; "
                               "give --start with PX_PER_M");
    case Localization::Status::NoStart:
      throw std::invalid_argument("the method needs --start or --start-from-reference");
  }
}

/// The smoothed poses at the keyframes.
std::vector<SmoothedPose> smoothed_poses(const RunRecord& record) {
  std::vector<SmoothedPose> poses;
  for (const Keyframe& keyframe : record.keyframes.keyframes) {
    const StepReport& report = record.steps.at(keyframe.step);
    poses.push_back({.sketch_from_robot = report.estimate.sketch_from_robot,
                     .covariance = Eigen::Matrix4d::Zero(),
                     .probability = report.localized_probability});
  }
  return poses;
}

/// Fills the record with what the method found and what it took.
void localize_into(RunRecord& record, const LocalizeOptions& options,
                   const LocalizationMethod& method, const LocalizationParams& params) {
  using Clock = std::chrono::steady_clock;
  if (record.run.steps.empty()) {
    require_done(Localization::Status::EmptyRun, options);
  }
  const std::unique_ptr<WarpPredictor> predictor =
      predictor_of(method, options.method, params.predictor);
  const LocalizationTask task{
      .method = method.method,
      .odometry = options.method.odometry,
      .start_sketch_from_robot = start_of(options, record),
      .predictor = predictor.get(),
      .smoothing = options.smoothing == Smoothing::None ? method.smoothing : options.smoothing};
  Progress progress("localize", steps_of_work(record.run, task));
  const Clock::time_point begin = Clock::now();
  LocalizationParams of_method = params;
  of_method.localizer = params_of(method, params.localizer);
  Localization found = localize(record.sketch, record.run, task, of_method,
                                [&](std::size_t done) { progress.update(done); });
  record.cost = RunCost{.seconds = std::chrono::duration<double>(Clock::now() - begin).count(),
                        .peak_memory_mb = peak_memory_mb()};
  require_done(found.status, options);
  record.steps = std::move(found.steps);
  record.snapshots = std::move(found.snapshots);
  record.filtered = std::move(found.filtered);
  record.keyframes = std::move(found.keyframes);
  if (task.smoothing != Smoothing::Whole) {
    return;
  }
  if (!record.filtered.empty()) {
    record.spline = spline_or_warning(record.keyframes, smoothed_poses(record),
                                      of_method.smoothing.spline, options.log);
  } else {
    spdlog::warn("{}: nothing could be registered, so that the run is not smoothed",
                 options.log.string());
  }
}

std::string start_text(const LocalizeOptions& options) {
  return !options.start.pose.empty()    ? options.start.pose
         : options.start.from_reference ? "first pose of the reference"
                                        : "anywhere in the drawing";
}

/// Everything that was given and that the result depends on.
RunDescription description_of(const LocalizeOptions& options, const LocalizationMethod& method,
                              const LocalizationParams& params, const Sketch& sketch) {
  RunDescription description{
      .command = "localize",
      .seed = options.method.seed,
      .inputs = {{"map", options.map.string()},
                 {"log", options.log.string()},
                 {"method", method.name},
                 {"odometry", name_of(odometry_sources(), options.method.odometry)}},
      .parameters = to_config(params),
      .drawing = PictureSize{.width_px = sketch.width_px(), .height_px = sketch.height_px()}};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) {
      description.inputs.emplace_back(option, value);
    }
  };
  add("network", options.method.network.string());
  add("smooth", options.smoothing == Smoothing::Whole ? "true" : "");
  add("lag", options.smoothing == Smoothing::Lagged ? "true" : "");
  add("start", options.start.pose);
  add("start-from-reference", options.start.from_reference ? "true" : "");
  add("global", options.start.has_pose() ? "" : "true");
  add("max-range-m",
      options.reading.max_range_m ? to_config(*options.reading.max_range_m).text : "");
  add("allow-truncated", options.reading.allow_truncated ? "true" : "");
  for (const auto& [option, value] : given_drawing_options(options.drawing)) {
    description.inputs.emplace_back(option, value);
  }
  add("reference", options.reference.string());
  for (const std::filesystem::path& csv : options.alternatives) {
    add("alternative", csv.string());
  }
  add("title", options.title);
  return description;
}

/// What the report says about the run, apart from its figures.
void describe(RunRecord& record, const LocalizeOptions& options, const LocalizationMethod& method,
              const LocalizationParams& params) {
  record.title = options.title.empty()
                     ? options.map.filename().string() + " with " + options.log.filename().string()
                     : options.title;
  record.inputs = {
      {"drawing", options.map.filename().string()},
      {"log", options.log.filename().string()},
      {"start", start_text(options)},
      {"method",
       method.name + " on " + name_of(odometry_sources(), options.method.odometry) + " odometry"}};
  record.parameters = to_yaml(to_config(params));
}

void add_algorithm_options(CLI::App& command, LocalizeOptions& options) {
  const auto option = [&](const std::string& flag, auto& value, const std::string& help) {
    return command.add_option(flag, value, help)->group(kAlgorithmGroup);
  };
  option("--map", options.map, "The drawing: PNG, JPEG, PGM, or a map_server YAML")
      ->required()
      ->type_name("DRAWING");
  option("--log", options.log, "The robot's log: CARMEN or JSON lines, plain or gzip")
      ->required()
      ->type_name("LOG");
  add_read_options(command, options.reading);
  add_drawing_options(command, options.drawing, "Of the drawing");
  add_start_options(command, options.start, "the reference");
  std::vector<std::string> names;
  std::ranges::transform(localization_methods(), std::back_inserter(names),
                         &LocalizationMethod::name);
  add_method_options(command, options.method, names);
  CLI::Option* smooth =
      command
          .add_flag_callback(
              "--smooth", [&options] { options.smoothing = Smoothing::Whole; },
              "Smooth the path after the run, with all that it showed; see docs/smoothing.md")
          ->group(kAlgorithmGroup);
  command
      .add_flag_callback(
          "--lag", [&options] { options.smoothing = Smoothing::Lagged; },
          "Each pose as it would have been known --smoothing.lag.lag_m later, while the robot "
          "drove")
      ->group(kAlgorithmGroup)
      ->excludes(smooth);
}

void add_other_options(CLI::App& command, LocalizeOptions& options) {
  command.add_option("--out", options.out, "Folder of the results")
      ->required()
      ->group(kOutputGroup)
      ->type_name("DIR");
  command.add_option("--reference", options.reference, "Where the robot was, to compare with")
      ->group(kOutputGroup)
      ->type_name("REF.csv");
  command
      .add_option("--alternative", options.alternatives,
                  "Another reading of the drawing that counts as right too")
      ->group(kOutputGroup)
      ->type_name("ALT.csv");
  command.add_option("--title", options.title, "Of the report")->group(kOutputGroup);
  command.add_flag("--force", options.force, "Replace an earlier result")->group(kOutputGroup);
  add_jobs_option(command, options.method.jobs);
}

/// The defaults for the --map that was given, as far as it was.
ConfigNode default_parameters(const LocalizeOptions& options) {
  return to_config(options.map.empty() ? LocalizationParams{}
                                       : defaults_for<LocalizationParams>(
                                             read_any_drawing(options.map, options.drawing)));
}

}  // namespace

void run_localize(const LocalizeOptions& options) {
  OutputFolder out(options.out, options.force);
  RunRecord record = read_inputs(options);
  const LocalizationMethod& method = method_of(options.method, record.sketch);
  check_starts(options, method);
  check_smoothing(options, method);
  const auto params =
      parameters_for<LocalizationParams>(record.sketch, options.parameters, options.method);
  localize_into(record, options, method, params);
  describe(record, options, method, params);
  write_result_files(out, record, description_of(options, method, params, record.sketch));
  out.commit();
  std::cout << summary_text(record) << "report: " << (out.target() / "report.html").string()
            << "\n";
}

void add_localize_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("localize", "Find the path of a robot in a drawing, from its log.");
  auto options = std::make_shared<LocalizeOptions>();
  add_algorithm_options(*command, *options);
  add_parameter_options(
      *command, [options = options.get()] { return default_parameters(*options); },
      options->parameters);
  add_other_options(*command, *options);
  command->callback([options] { run_localize(*options); });
}

}  // namespace sketchloc
