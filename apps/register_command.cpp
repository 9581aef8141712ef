#include "apps/register_command.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "apps/given_network.hpp"
#include "apps/inputs.hpp"
#include "apps/option_checks.hpp"
#include "apps/output_folder.hpp"
#include "apps/program.hpp"
#include "apps/progress.hpp"
#include "apps/read_options.hpp"
#include "apps/run_file.hpp"
#include "apps/start_pose.hpp"
#include "datasets/io/atomic_file.hpp"
#include "eval/registration_picture.hpp"
#include "eval/registration_report.hpp"
#include "eval/registration_result.hpp"
#include "motion/angles.hpp"
#include "motion/number_text.hpp"
#include "registration/alignment.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

/// The scan that was asked for, as an index.
std::size_t chosen_step(const RegisterOptions& options, const Run& run) {
  if (run.steps.empty()) {
    throw std::runtime_error(options.log.string() + ": has no scans");
  }
  if (!options.time_s) {
    const std::size_t step = options.scan.value_or(0);
    if (step >= run.steps.size()) {
      throw std::invalid_argument(fmt::format("--scan {}: {} has scans 0 to {}", step,
                                              options.log.string(), run.steps.size() - 1));
    }
    return step;
  }
  const double first_s = run.steps.front().scan.time_s;
  const double last_s = run.steps.back().scan.time_s;
  if (*options.time_s < first_s || *options.time_s > last_s) {
    throw std::invalid_argument("--time " + number_text(*options.time_s) + ": " +
                                options.log.string() + " has scans from " + number_text(first_s) +
                                " to " + number_text(last_s) + " s");
  }
  const auto nearest = std::ranges::min_element(run.steps, {}, [&](const RunStep& step) {
    return std::abs(step.scan.time_s - *options.time_s);
  });
  return static_cast<std::size_t>(nearest - run.steps.begin());
}

/// The scans of the last metres up to a step, placed by matched odometry.
RecentScans submap_at(std::size_t step, const Run& run, const RegisterParams& params) {
  MatchedOdometry odometry(params.odometry);
  RecentScans recent(params.submap);
  Progress progress("match", step + 1);
  for (std::size_t i = 0; i <= step; ++i) {
    const RunStep& now = run.steps[i];
    recent.add(now.scan, odometry.step(now.scan, now.odom_from_robot).odom_from_robot);
    progress.update(i + 1);
  }
  return recent;
}

/// The scan alone, as a submap.
RecentScans alone(const Scan& scan) {
  RecentScans recent;
  recent.add(scan, {});
  return recent;
}

std::optional<ReferencePose> reference_at(const RegisterOptions& options, const Sketch& sketch,
                                          const Run& run, std::size_t step) {
  if (options.reference.empty()) {
    return std::nullopt;
  }
  const Reference reference =
      read_reference_input(options.reference, sketch.height_px(), {run, options.log});
  const auto pose = std::ranges::find(reference.poses, step, &ReferencePose::step);
  if (pose == reference.poses.end()) {
    warn_of(options.reference, {"has no pose for scan " + std::to_string(step)});
    return std::nullopt;
  }
  if (!pose->scored) {
    warn_of(options.reference, {"its pose for scan " + std::to_string(step) +
                                " lies outside of the drawing or of what supports it"});
  }
  return *pose;
}

/// What was read and what was found.
struct Registered {
  Sketch sketch;
  RecentScans submap;
  RegistrationResult result;

  RegistrationView view(std::span<const PlacedScan> placed) const {
    const auto& reference = result.reference;
    return {.sketch = &sketch,
            .submap = placed,
            .prior_sketch_from_robot = result.prior_sketch_from_robot,
            .registration = result.registration ? &*result.registration : nullptr,
            .true_sketch_from_robot =
                reference ? std::optional(reference->sketch_from_robot) : std::nullopt,
            .window = result.window};
  }
};

void register_into(RegistrationResult& result, WarpPredictor& predictor,
                   std::span<const PlacedScan> submap, const Sketch& sketch) {
  using Clock = std::chrono::steady_clock;
  const SketchCropper cropper(sketch);
  const Clock::time_point begin = Clock::now();
  auto found = predictor.predict(submap, cropper, std::span(&result.prior_sketch_from_robot, 1));
  result.milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
  result.registration = std::move(found.front());
  if (result.registration) {
    result.window = result.registration->window;
    result.alignment = alignment_score(submap, cropper, result.registration->warp, result.window);
  }
}

Registered register_scan(const RegisterOptions& options, const RegisterParams& params) {
  const std::unique_ptr<WarpPredictor> predictor =
      predictor_from(options.method, options.network, params.predictor);
  Sketch sketch = read_drawing_input(options.map, options.drawing);
  const Run run = read_log_input(options.log, options.reading);
  const std::size_t step = chosen_step(options, run);
  const Scan& scan = run.steps[step].scan;
  if (end_points_in_robot(scan).empty()) {
    throw std::runtime_error(
        fmt::format("{}: scan {} has no return, so that nothing tells where it was taken; choose "
                    "another --scan",
                    options.log.string(), step));
  }
  RegistrationResult result{.step = step,
                            .time_s = scan.time_s,
                            .window = params.predictor.window,
                            .prior_sketch_from_robot = pose_in_drawing(options.prior, "--prior",
                                                                       {sketch, options.map}, scan),
                            .registration = std::nullopt,
                            .reference = reference_at(options, sketch, run, step)};
  const bool one_scan = options.single_scan || takes_one_scan(options.method);
  Registered registered{.sketch = std::move(sketch),
                        .submap = one_scan ? alone(scan) : submap_at(step, run, params),
                        .result = std::move(result)};
  const std::vector<PlacedScan> placed = registered.submap.placed();
  registered.result.scans = placed.size();
  register_into(registered.result, *predictor, placed, registered.sketch);
  return registered;
}

std::string text_of(const PoseDifference& difference) {
  return fmt::format("{:.2f} m, {:.1f} deg, scale x {:.2f}", difference.shift_m,
                     deg_from_rad(difference.turn_rad), difference.scale_ratio);
}

std::string pose_text(const Registration& found, const RegistrationResult& result) {
  const Sim2& pose = found.sketch_from_robot;
  std::string text = fmt::format(
      "pose: x {:.1f} px, y {:.1f} px, heading {:.1f} deg, {:.1f} px/m\nfrom the prior: {}\n",
      pose.x(), pose.y(), deg_from_rad(pose.yaw_rad()), pose.scale(),
      text_of(difference(pose, result.prior_sketch_from_robot)));
  if (found.covariance) {
    const PoseSigma sigma = sigma_of(*found.covariance);
    text += fmt::format("1-sigma: {:.2f} m, {:.1f} deg; probability that it is right: {:.0f} %\n",
                        sigma.position_m, deg_from_rad(sigma.heading_rad),
                        100.0 * found.inlier_probability);
  }
  text += fmt::format("alignment of the bent scan with the strokes: {:.2f}\n", result.alignment);
  return text +
         fmt::format("the warp {} within the window of {:g} m\n",
                     find_folds(found.warp, result.window).folds() ? "folds" : "does not fold",
                     result.window.side_m);
}

std::string reference_text(const RegistrationResult& result) {
  const Sim2& reference = result.reference->sketch_from_robot;
  std::string text = "from the reference: ";
  if (result.registration) {
    text += text_of(difference(result.registration->sketch_from_robot, reference)) + "; prior: ";
  }
  text += text_of(difference(result.prior_sketch_from_robot, reference));
  if (result.reference->uncertainty_m > 0.0) {
    text += fmt::format("; its own 1-sigma: {:.2f} m", result.reference->uncertainty_m);
  }
  return text + "\n";
}

std::string summary_text(const RegistrationResult& result) {
  std::string text = result.registration ? pose_text(*result.registration, result)
                                         : "nothing was found: the warp folds at the robot\n";
  text += result.reference ? reference_text(result) : "";
  return text + fmt::format("scan {} at {:.2f} s, {} in all, {:.1f} ms\n", result.step,
                            result.time_s, result.scans, result.milliseconds);
}

/// Everything that was given and that the result depends on.
RunDescription description_of(const RegisterOptions& options, const RegisterParams& params,
                              const Sketch& sketch) {
  RunDescription description{
      .command = "register",
      .seed = std::nullopt,
      .inputs = {{"map", options.map.string()}, {"log", options.log.string()}},
      .parameters = to_config(params),
      .drawing = PictureSize{.width_px = sketch.width_px(), .height_px = sketch.height_px()}};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) {
      description.inputs.emplace_back(option, value);
    }
  };
  add("scan", options.time_s ? "" : std::to_string(options.scan.value_or(0)));
  add("time", options.time_s ? number_text(*options.time_s) : "");
  add("prior", options.prior);
  add("method", name_of(registration_methods(), options.method));
  add("network", options.network.string());
  add("single-scan", options.single_scan ? "true" : "");
  add("max-range-m",
      options.reading.max_range_m ? to_config(*options.reading.max_range_m).text : "");
  add("allow-truncated", options.reading.allow_truncated ? "true" : "");
  for (const auto& [option, value] : given_drawing_options(options.drawing)) {
    add(option.c_str(), value);
  }
  add("reference", options.reference.string());
  return description;
}

std::vector<NamedText> named_inputs(const RunDescription& description) {
  std::vector<NamedText> inputs;
  for (const auto& [option, value] : description.inputs) {
    inputs.push_back({.name = option, .text = value});
  }
  return inputs;
}

/// What people read; files by their names alone.
std::vector<NamedText> titles(const RegisterOptions& options) {
  return {{"drawing", options.map.filename().string()},
          {"log", options.log.filename().string()},
          {"prior", options.prior},
          {"method", name_of(registration_methods(), options.method)}};
}

void add_algorithm_options(CLI::App& command, RegisterOptions& options) {
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
  CLI::Option* scan = option("--scan", options.scan, "Which scan of the log, from 0 on (default 0)")
                          ->check(whole_number())
                          ->type_name("N");
  option("--time", options.time_s, "The scan nearest to this time of the log instead, in s")
      ->check(non_negative_number())
      ->type_name("T")
      ->excludes(scan);
  scan->excludes(command.get_option("--time"));
  option("--prior", options.prior,
         "Where the robot may be: x right and y up from the lower left corner in px, heading "
         "counter-clockwise")
      ->required()
      ->check(
          [](const std::string& text) { return parse_start_pose(text, "--prior"), std::string(); })
      ->type_name("X,Y,HEADING_DEG[,PX_PER_M]");
  add_named_option(command, "--method", options.method, registration_methods(),
                   "ours, chen20 (the published network), affine (the same without bending) or "
                   "icp; the middle two look at one scan only")
      ->group(kAlgorithmGroup);
  option("--network", options.network,
         "A network that sketchloc train made, instead of the one that comes with the program")
      ->type_name("FILE.onnx");
  command
      .add_flag("--single-scan", options.single_scan,
                "Look at this scan alone, not at those of the last metres with it")
      ->group(kAlgorithmGroup);
}

void add_output_options(CLI::App& command, RegisterOptions& options) {
  command
      .add_option("--out", options.out,
                  "Folder for registration.json, registration.png, report.html and run.yaml")
      ->group(kOutputGroup)
      ->type_name("DIR");
  command.add_option("--reference", options.reference, "Where the robot was, to compare with")
      ->group(kOutputGroup)
      ->type_name("REF.csv");
  command.add_flag("--json", options.json, "Print registration.json instead of lines for people")
      ->group(kOutputGroup);
  command.add_flag("--force", options.force, "Replace an earlier result")->group(kOutputGroup);
}

}  // namespace

void run_register(const RegisterOptions& options) {
  const auto params = parameters_from<RegisterParams>(options.parameters);
  std::optional<OutputFolder> out;
  if (options.out) {
    out.emplace(*options.out, options.force);
  }
  const Registered registered = register_scan(options, params);
  const RunDescription description = description_of(options, params, registered.sketch);
  const std::string json = to_json(registered.result, named_inputs(description));
  if (out) {
    const std::vector<PlacedScan> placed = registered.submap.placed();
    const RegistrationView view = registered.view(placed);
    write_atomically(*out / "registration.json", json);
    write_atomically(*out / "registration.png", registration_png(view));
    write_atomically(*out / "report.html",
                     registration_html(view, registered.result, titles(options)));
    write_atomically(*out / "run.yaml", run_file_text(description));
    out->commit();
  }
  std::cout << (options.json ? json : summary_text(registered.result));
  if (out && !options.json) {
    std::cout << "report: " << (out->target() / "report.html").string() << "\n";
  }
}

void add_register_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "register", "Fit one scan into a drawing, bending it, from a rough pose.");
  const auto options = std::make_shared<RegisterOptions>();
  add_algorithm_options(*command, *options);
  add_parameter_options(*command, to_config(RegisterParams{}), options->parameters);
  add_output_options(*command, *options);
  command->callback([options] { run_register(*options); });
}

}  // namespace sketchloc
