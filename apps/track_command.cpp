#include "apps/track_command.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>

#include "apps/fingerprint.hpp"
#include "apps/inputs.hpp"
#include "apps/line_sink.hpp"
#include "apps/option_checks.hpp"
#include "apps/program.hpp"
#include "apps/read_bytes.hpp"
#include "apps/read_options.hpp"
#include "apps/replay_source.hpp"
#include "apps/start_pose.hpp"
#include "apps/state_file.hpp"
#include "apps/stream_source.hpp"
#include "apps/tcp_source.hpp"
#include "apps/track_loop.hpp"
#include "apps/version.hpp"
#include "datasets/io/reference_io.hpp"
#include "motion/number_text.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

constexpr double kUsualDeadline_ms = 50.0;

/// The drawing of a data set, or the drawing itself.
fs::path drawing_of(const fs::path& map) {
  if (!fs::is_directory(map)) {
    return map;
  }
  for (const char* name : {"drawing.yaml", "drawing.png"}) {
    if (fs::exists(map / name)) {
      return map / name;
    }
  }
  throw std::invalid_argument(map.string() +
                              ": is a folder without drawing.png; give a drawing, or a data set of "
                              "sketchloc generate");
}

void check_state(const TrackOptions& options) {
  const fs::path folder = fs::absolute(options.state).parent_path();
  if (!fs::is_directory(folder)) {
    throw std::invalid_argument("--state " + options.state.string() + ": there is no folder " +
                                folder.string());
  }
  if (!fs::exists(options.state)) {
    return;
  }
  if (!fs::is_regular_file(options.state)) {
    throw std::invalid_argument("--state " + options.state.string() + ": is no file");
  }
  if (!options.resume && !options.force) {
    throw std::invalid_argument(
        options.state.string() +
        " exists; give --resume to go on from it, --force to begin anew, or another --state");
  }
}

void check_options(const TrackOptions& options) {
  if (options.rate && options.replay.empty()) {
    throw std::invalid_argument("--rate is of a --replay; give both or none");
  }
  if ((options.reading.max_range_m || options.reading.allow_truncated) && options.replay.empty()) {
    throw std::invalid_argument("--max-range-m and --allow-truncated are of a --replay");
  }
  if (options.resume && options.state.empty()) {
    throw std::invalid_argument("--resume needs the --state to go on from");
  }
  if (!options.state.empty()) {
    check_state(options);
  }
  if (options.start.from_reference && !fs::is_directory(options.map)) {
    throw std::invalid_argument(
        "--start-from-reference needs a data set with a reference.csv, but " +
        options.map.string() + " is no folder; give --start");
  }
}

/// The first look of a network takes many times as long as the others: before the first scan comes.
void warm_up(WarpPredictor& predictor, const Sketch& sketch, const TrackParams& params) {
  const SketchCropper cropper(sketch);
  const Scan scan{.first_angle_rad = -1.0,
                  .angle_step_rad = 0.1,
                  .max_range_m = 10.0,
                  .robot_from_laser = {},
                  .ranges_m = std::vector<float>(20, 1.0F)};
  const std::vector<PlacedScan> submap = {{.scan = &scan, .robot_from_then = {}}};
  const Sim2 middle = Sim2::from_xy_yaw_scale(0.5 * sketch.width_px(), 0.5 * sketch.height_px(),
                                              0.0, sketch.px_per_m.value_or(20.0));
  for (int priors = params.localizer.fusion.max_modes; priors >= 1; --priors) {
    predictor.predict(submap, cropper, std::vector<Sim2>(static_cast<std::size_t>(priors), middle));
  }
}

/// How the filter starts: at a pose if one was given, else anywhere.
StartLocalizer starter_of(const TrackOptions& options, const NamedSketch& drawing) {
  if (options.start.from_reference) {
    const Reference reference =
        read_reference(options.map / "reference.csv", drawing.sketch.height_px());
    if (reference.poses.empty()) {
      throw std::runtime_error((options.map / "reference.csv").string() +
                               ": has no poses to start from; give --start");
    }
    const Sim2 pose = reference.poses.front().sketch_from_robot;
    return [pose](Localizer& localizer, const Scan&) { return localizer.start_at(pose), true; };
  }
  if (!options.start.pose.empty()) {
    const StartPose start = start_pose_in(options.start.pose, "--start", drawing);
    return [start, &sketch = drawing.sketch](Localizer& localizer, const Scan& scan) {
      const std::optional<Sim2> pose = pose_at(start, "--start", sketch, scan);
      if (pose) {
        localizer.start_at(*pose);
      }
      return pose.has_value();
    };
  }
  return [file = drawing.file](Localizer& localizer, const Scan& scan) {
    const GlobalStart start = localizer.start_anywhere(scan);
    if (start == GlobalStart::NoFreeSpace) {
      throw std::runtime_error(file.string() +
                               ": encloses no free space to start in; give --start");
    }
    return start == GlobalStart::Started;
  };
}

/// All that a state depends on, in lines.
std::string what_a_state_is_of(const TrackOptions& options, const Sketch& sketch,
                               const TrackParams& params) {
  std::string text = fmt::format("program: {}\ndrawing: {} x {} px, {}\n", version_text(),
                                 sketch.width_px(), sketch.height_px(),
                                 fingerprint(std::as_bytes(std::span(sketch.occupied.cells()))));
  text += "px_per_m: " + (sketch.px_per_m ? number_text(*sketch.px_per_m) : "unknown") + "\n";
  text += "odometry: " + name_of(odometry_sources(), options.method.odometry) + "\n";
  text += "method: " + method_of(options.method, sketch).name + "\n";
  const fs::path& network = options.method.network;
  text += "network: " +
          (network.empty() ? std::string("the program's own") : fingerprint_of_file(network)) +
          "\n";
  text += "seed: " + number_text(options.method.seed) + "\n";
  return text + to_yaml(to_config(params));
}

void resume(Tracker& tracker, const TrackOptions& options, const std::string& what) {
  const std::optional<std::string> file = read_bytes(options.state);
  if (!file) {
    spdlog::info("{} is not there yet; begins anew", options.state.string());
    return;
  }
  const std::string bytes = state_in(*file, what, options.state);
  try {
    StateReader reader(bytes);
    tracker.load(reader);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(options.state.string() + ": " + error.what() +
                             "; begin anew with --force instead of --resume");
  }
  spdlog::info("goes on from {}", options.state.string());
}

LineSink sink_of(const TrackOptions& options) {
  if (options.out.empty()) {
    return {};
  }
  return {options.out, options.resume  ? LineSink::Existing::Append
                       : options.force ? LineSink::Existing::Replace
                                       : LineSink::Existing::Refuse};
}

std::unique_ptr<MessageSource> source_of(const TrackOptions& options, const Run& replayed) {
  if (!options.replay.empty()) {
    return std::make_unique<ReplaySource>(replayed, options.rate.value_or(1.0));
  }
  if (options.listen) {
    auto source = std::make_unique<TcpSource>(*options.listen);
    spdlog::info("listens on 127.0.0.1:{}", source->port());
    return source;
  }
  return std::make_unique<StreamSource>(STDIN_FILENO, "stdin");
}

/// Who else hears of what was tracked; nobody without a lag.
HearTracked hearer_of(std::optional<LaggedTrack>& lagged) {
  if (!lagged) {
    return {};
  }
  return [&lagged](const RunStep& step, const TrackedScan& scan) { lagged->hear(step, scan); };
}

/// None where nothing is ever too late.
std::optional<double> deadline_of(const TrackOptions& options) {
  const bool hurried = options.rate.value_or(1.0) == 0.0;  // nobody waits for the poses
  const double deadline_ms = options.deadline_ms.value_or(hurried ? 0.0 : kUsualDeadline_ms);
  return deadline_ms > 0.0 ? std::optional(1e-3 * deadline_ms) : std::nullopt;
}

}  // namespace

void validate(const TrackParams& params) {
  validate_part("localizer", params.localizer);
  validate_part("odometry", params.odometry);
  validate_part("predictor", params.predictor);
  validate_part("tracker", params.tracker);
  validate_part("smoothing", params.smoothing);
}

void run_track(const TrackOptions& options) {
  check_options(options);
  const fs::path file = drawing_of(options.map);
  const Sketch sketch = read_drawing_input(file, options.drawing);
  const auto params = parameters_for<TrackParams>(sketch, options.parameters, options.method);
  const LocalizationMethod& method = method_of(options.method, sketch);
  const std::unique_ptr<WarpPredictor> predictor =
      predictor_of(method, options.method, params.predictor);
  const NamedSketch drawing{sketch, file};
  const Run replayed =
      options.replay.empty() ? Run() : read_log_input(options.replay, options.reading);

  Localizer localizer(sketch, params_of(method, params.localizer), predictor.get());
  OdometryFeed odometry(options.method.odometry, params.odometry);
  const std::optional<double> deadline_s = deadline_of(options);
  std::optional<LaggedTrack> lagged;
  if (options.lag) {
    if (!predictor) {
      throw std::invalid_argument("--lag needs a filter with registrations; give --method ours");
    }
    lagged.emplace(sketch, *predictor, params_of(method, params.localizer), params.smoothing);
  }
  Tracker tracker(params.tracker, {.localizer = localizer,
                                   .odometry = odometry,
                                   .start = starter_of(options, drawing),
                                   .clock = steady_now_s,
                                   .deadline_s = deadline_s,
                                   .hear_tracked = hearer_of(lagged)});
  const std::string what = what_a_state_is_of(options, sketch, params);
  if (options.resume) {
    resume(tracker, options, what);
  }
  if (predictor) {
    warm_up(*predictor, sketch, params);
  }
  LineSink sink = sink_of(options);
  std::optional<StateKeeper> keeper;
  if (!options.state.empty()) {
    keeper.emplace(options.state, what);
  }
  const std::unique_ptr<MessageSource> source = source_of(options, replayed);
  TrackLoop loop({.tracker = tracker,
                  .source = *source,
                  .write = [&](std::string_view line) { return sink.write(line); },
                  .lagged = lagged ? &*lagged : nullptr,
                  .keeper = keeper ? &*keeper : nullptr,
                  .state_every_s = options.state_every_s,
                  .deadline_s = deadline_s});
  sink.write(loop.run());
}

namespace {

/// The methods that run online.
std::vector<std::string> filters() {
  std::vector<std::string> names;
  for (const LocalizationMethod& method : localization_methods()) {
    if (method.smoothing == Smoothing::None && method.method == Method::Mcl) {
      names.push_back(method.name);
    }
  }
  return names;
}

void add_algorithm_options(CLI::App& command, TrackOptions& options) {
  command
      .add_option(
          "map,--map", options.map,
          "The drawing: PNG, JPEG, PGM, a map_server YAML, or a folder of sketchloc generate")
      ->required()
      ->group(kAlgorithmGroup)
      ->type_name("DRAWING|DATA_SET");
  add_drawing_options(command, options.drawing, "Of the drawing");
  add_start_options(command, options.start, "the data set's reference");
  add_method_options(command, options.method, filters());
}

/// Where messages come from, at most one of them, and when.
void add_input_options(CLI::App& command, TrackOptions& options) {
  CLI::Option* from_stdin =
      command.add_flag("--stdin", options.from_stdin, "Messages come from stdin (default)")
          ->group(kAlgorithmGroup);
  CLI::Option* listen =
      command
          .add_option("--listen", options.listen,
                      "Messages come from whoever connects to this TCP port of 127.0.0.1, and the "
                      "poses go back there too; 0: any free port")
          ->check([](const std::string& text) {
            const auto port = parse_number<std::uint16_t>(text);
            return port ? std::string() : "must be a port, 0 to 65535, but it is '" + text + "'";
          })
          ->group(kAlgorithmGroup)
          ->type_name("PORT");
  CLI::Option* replay =
      command
          .add_option("--replay", options.replay,
                      "Messages are the steps of a log, CARMEN or JSON lines, plain or gzip")
          ->group(kAlgorithmGroup)
          ->type_name("LOG");
  command
      .add_option("--rate", options.rate,
                  "Seconds of the replayed log per second [1]; 0: as fast as possible")
      ->check(non_negative_number())
      ->group(kAlgorithmGroup)
      ->type_name("NUMBER");
  command
      .add_option("--deadline-ms", options.deadline_ms,
                  "From a scan's arrival to its pose [50]; 0: none (as for --rate 0)")
      ->check(non_negative_number())
      ->group(kAlgorithmGroup)
      ->type_name("MS");
  from_stdin->excludes(listen)->excludes(replay);
  listen->excludes(replay);
  command
      .add_flag(
          "--lag", options.lag,
          "Smoothed poses too, a line for each once the robot is --smoothing.lag.lag_m beyond")
      ->group(kAlgorithmGroup);
  add_read_options(command, options.reading);
}

void add_output_options(CLI::App& command, TrackOptions& options) {
  command.add_option("--out", options.out, "File of the poses, instead of stdout")
      ->group(kOutputGroup)
      ->type_name("FILE");
  command
      .add_option("--state", options.state,
                  "File that keeps what the program knows, so that it can go on after any end")
      ->group(kOutputGroup)
      ->type_name("FILE");
  command.add_option("--state-every-s", options.state_every_s, "How often the state is kept")
      ->check(positive_number())
      ->group(kOutputGroup)
      ->capture_default_str();
  command
      .add_flag("--resume", options.resume,
                "Go on from the --state, if it is there; poses are added to --out")
      ->group(kOutputGroup);
  command.add_flag("--force", options.force, "Replace earlier poses and an earlier state")
      ->group(kOutputGroup);
}

/// The defaults for the map that was given, as far as it was.
ConfigNode default_parameters(const TrackOptions& options) {
  return to_config(options.map.empty() ? TrackParams{}
                                       : defaults_for<TrackParams>(read_any_drawing(
                                             drawing_of(options.map), options.drawing)));
}

}  // namespace

void add_track_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "track", "Follow a robot in a drawing while it drives: messages in, a pose per scan out.");
  auto options = std::make_shared<TrackOptions>();
  add_algorithm_options(*command, *options);
  add_input_options(*command, *options);
  add_parameter_options(
      *command, [options = options.get()] { return default_parameters(*options); },
      options->parameters);
  add_output_options(*command, *options);
  add_jobs_option(*command, options->method.jobs);
  command->callback([options] { run_track(*options); });
}

}  // namespace sketchloc
