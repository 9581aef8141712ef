#include "apps/localize_command.hpp"

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
#include "apps/start_pose.hpp"
#include "apps/version.hpp"
#include "datasets/io/reference_io.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_io.hpp"

namespace sketchloc {
namespace {

const std::map<std::string, Method> kMethods = {
    {"mcl", Method::Mcl}, {"chained", Method::Chained}, {"odometry", Method::Odometry}};
constexpr const char* kNoRegistration = "none";
constexpr const char* kSaysHowSureItIs = "ours";

const std::map<std::string, OdometrySource> kOdometrySources = {
    {"matched", OdometrySource::Matched}, {"raw", OdometrySource::Raw}};

void check_starts(const LocalizeOptions& options) {
  const int starts = (options.start.empty() ? 0 : 1) + (options.start_from_reference ? 1 : 0) +
                     (options.global ? 1 : 0);
  if (starts > 1) {
    throw std::invalid_argument(
        "give one of --start, --start-from-reference and --global, not several");
  }
  if (options.start_from_reference && options.reference.empty()) {
    throw std::invalid_argument("--start-from-reference needs --reference REF.csv");
  }
  if (options.start.empty() && !options.start_from_reference && options.method != Method::Mcl) {
    throw std::invalid_argument("--method " + name_of(kMethods, options.method) +
                                " needs --start or --start-from-reference");
  }
  if (options.method == Method::Chained && options.registration == kNoRegistration) {
    throw std::invalid_argument("--method chained needs a --registration");
  }
  if (options.method == Method::Mcl && options.registration != kNoRegistration &&
      options.registration != kSaysHowSureItIs) {
    throw std::invalid_argument("--registration " + options.registration +
                                " does not say how sure it is, so that the filter cannot use it; "
                                "give ours, or --method chained");
  }
  if (options.method == Method::Odometry && options.registration != kNoRegistration) {
    throw std::invalid_argument("--method odometry uses no --registration");
  }
}

/// Reads all inputs into the record of the run.
RunRecord read_inputs(const LocalizeOptions& options) {
  RunRecord record;
  record.seed = options.seed;
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

/// What registers scans for the filter; none: nothing does.
std::unique_ptr<WarpPredictor> predictor_of(const LocalizeOptions& options,
                                            const LocalizationParams& params) {
  if (options.registration == kNoRegistration) {
    if (!options.network.empty()) {
      throw std::invalid_argument("--network needs a --registration that runs one");
    }
    return nullptr;
  }
  run_networks_on_one_thread();
  return predictor_from(registration_methods().at(options.registration), options.network,
                        params.predictor);
}

/// Where the run starts; none: anywhere.
std::optional<Sim2> start_of(const LocalizeOptions& options, const RunRecord& record) {
  if (!options.start.empty()) {
    return pose_in_drawing(options.start, "--start", {record.sketch, options.map},
                           record.run.steps.front().scan);
  }
  if (!options.start_from_reference) {
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
      throw std::invalid_argument("--method " + name_of(kMethods, options.method) +
                                  " needs --start or --start-from-reference");
  }
}

/// A map in true proportions has other defaults than a drawing.
LocalizationParams defaults_for(const Sketch& sketch) {
  LocalizationParams defaults;
  if (sketch.px_per_m) {
    defaults.localizer = metric_localizer_params();
  }
  return defaults;
}

LocalizationParams parameters_for(const Sketch& sketch, const LocalizeOptions& options) {
  LocalizationParams params =
      parameters_from<LocalizationParams>(options.parameters, defaults_for(sketch));
  params.localizer.seed = options.seed;
  params.localizer.jobs = static_cast<int>(std::min(thread_count(options.jobs), 1024U));
  validate(params);
  return params;
}

/// Fills the record with what the method found and what it took.
void localize_into(RunRecord& record, const LocalizeOptions& options,
                   const LocalizationParams& params) {
  using Clock = std::chrono::steady_clock;
  if (record.run.steps.empty()) {
    require_done(Localization::Status::EmptyRun, options);
  }
  const std::unique_ptr<WarpPredictor> predictor = predictor_of(options, params);
  const LocalizationTask task{.method = options.method,
                              .odometry = options.odometry,
                              .start_sketch_from_robot = start_of(options, record),
                              .predictor = predictor.get()};
  Progress progress("localize", record.run.steps.size());
  const Clock::time_point begin = Clock::now();
  Localization found = localize(record.sketch, record.run, task, params,
                                [&](std::size_t done) { progress.update(done); });
  record.cost = RunCost{.seconds = std::chrono::duration<double>(Clock::now() - begin).count(),
                        .peak_memory_mb = peak_memory_mb()};
  require_done(found.status, options);
  record.steps = std::move(found.steps);
  record.snapshots = std::move(found.snapshots);
}

std::string start_text(const LocalizeOptions& options) {
  return !options.start.empty()         ? options.start
         : options.start_from_reference ? "first pose of the reference"
                                        : "anywhere in the drawing";
}

/// Everything that was given and that the result depends on.
RunDescription description_of(const LocalizeOptions& options, const LocalizationParams& params,
                              const Sketch& sketch) {
  RunDescription description{
      .command = "localize",
      .seed = options.seed,
      .inputs = {{"map", options.map.string()},
                 {"log", options.log.string()},
                 {"method", name_of(kMethods, options.method)},
                 {"odometry", name_of(kOdometrySources, options.odometry)},
                 {"registration", options.registration}},
      .parameters = to_config(params),
      .drawing = PictureSize{.width_px = sketch.width_px(), .height_px = sketch.height_px()}};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) {
      description.inputs.emplace_back(option, value);
    }
  };
  add("network", options.network.string());
  add("start", options.start);
  add("start-from-reference", options.start_from_reference ? "true" : "");
  add("global", options.start.empty() && !options.start_from_reference ? "true" : "");
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
void describe(RunRecord& record, const LocalizeOptions& options, const LocalizationParams& params) {
  record.title = options.title.empty()
                     ? options.map.filename().string() + " with " + options.log.filename().string()
                     : options.title;
  record.inputs = {{"drawing", options.map.filename().string()},
                   {"log", options.log.filename().string()},
                   {"start", start_text(options)},
                   {"method", name_of(kMethods, options.method) + " on " +
                                  name_of(kOdometrySources, options.odometry) +
                                  " odometry, registration: " + options.registration}};
  record.parameters = to_yaml(to_config(params));
}

/// At most one of them; what the command line says replaces any other of a --config file.
void add_start_options(CLI::App& command, LocalizeOptions& options) {
  CLI::Option* start =
      command
          .add_option("--start", options.start,
                      "Where the robot starts in the drawing: x right and y up from the lower left "
                      "corner in px, heading counter-clockwise")
          ->check([](const std::string& text) { return parse_start_pose(text), std::string(); })
          ->group(kAlgorithmGroup)
          ->type_name("X,Y,HEADING_DEG[,PX_PER_M]");
  CLI::Option* from_reference =
      command
          .add_flag("--start-from-reference", options.start_from_reference,
                    "Start at the reference's first pose")
          ->group(kAlgorithmGroup);
  CLI::Option* global =
      command.add_flag("--global", options.global, "Start anywhere in the drawing (default)")
          ->group(kAlgorithmGroup);
  start->excludes(from_reference)->excludes(global);
  from_reference->excludes(global);
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
  add_start_options(command, options);
  add_named_option(command, "--method", options.method, kMethods,
                   "mcl; chained: one registration after the other, without a filter; or odometry: "
                   "dead reckoning from the start")
      ->group(kAlgorithmGroup);
  add_named_option(command, "--odometry", options.odometry, kOdometrySources,
                   "matched (refined by scan matching) or raw")
      ->group(kAlgorithmGroup);
  option("--registration", options.registration,
         "What registers scans: none, or ours to help the filter; with --method chained also "
         "chen20, affine and icp")
      ->check([](const std::string& name) {
        return name == kNoRegistration || registration_methods().contains(name)
                   ? std::string()
                   : "there is no registration " + name +
                         "; there are none, ours, chen20, affine and icp";
      })
      ->capture_default_str();
  option("--network", options.network,
         "A network that sketchloc train made, instead of the one that comes with the program")
      ->type_name("FILE.onnx");
  option("--seed", options.seed, "Of all randomness; the same seed gives the same result")
      ->check(whole_number())
      ->capture_default_str();
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
  add_jobs_option(command, options.jobs);
}

/// The defaults for the --map that was given, as far as it was.
ConfigNode default_parameters(const LocalizeOptions& options) {
  return to_config(options.map.empty()
                       ? LocalizationParams{}
                       : defaults_for(read_any_drawing(options.map, options.drawing)));
}

}  // namespace

void run_localize(const LocalizeOptions& options) {
  check_starts(options);
  OutputFolder out(options.out, options.force);
  RunRecord record = read_inputs(options);
  const LocalizationParams params = parameters_for(record.sketch, options);
  localize_into(record, options, params);
  describe(record, options, params);
  write_result_files(out, record, description_of(options, params, record.sketch));
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
