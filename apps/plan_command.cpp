#include "apps/plan_command.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <vector>

#include "apps/inputs.hpp"
#include "apps/option_checks.hpp"
#include "apps/output_folder.hpp"
#include "apps/program.hpp"
#include "apps/read_options.hpp"
#include "apps/run_file.hpp"
#include "apps/start_pose.hpp"
#include "datasets/io/atomic_file.hpp"
#include "datasets/io/csv_table.hpp"
#include "eval/plan_record.hpp"
#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// A place as people type it; a heading may be left out.
StartPose place_from(const std::string& text, const std::string& flag) {
  const bool has_heading = std::ranges::count(text, ',') > 1;
  return parse_start_pose(has_heading ? text : text + ",0", flag);
}

/// Of a place as people type it, where it has one.
std::optional<double> heading_of(const std::string& text, const std::string& flag) {
  return std::ranges::count(text, ',') > 1 ? std::optional(place_from(text, flag).heading_rad)
                                           : std::nullopt;
}

ScaleField scale_field(const PlanOptions& options, const Sketch& sketch, const StartPose& start,
                       const ScaleFieldParams& params) {
  if (!options.scales.empty()) {
    constexpr double kMost = 1e6;
    std::vector<ScaleSample> samples;
    for_each_csv_row(options.scales, {"x_px", "y_px", "scale_px_per_m"}, [&](const CsvRow& row) {
      samples.push_back({{row.number("x_px", kMost), row.number("y_px", kMost)},
                         row.above_zero("scale_px_per_m", kMost)});
    });
    return {sketch.width_px(), sketch.height_px(), samples, params};
  }
  const std::optional<double> px_per_m = start.px_per_m ? start.px_per_m : sketch.px_per_m;
  if (!px_per_m) {
    throw std::invalid_argument(
        "--start " + options.start +
        ": nothing tells how large the robot is in this drawing; give X,Y,HEADING_DEG,PX_PER_M, or "
        "the trajectory.csv of a run in it with --scales");
  }
  return ScaleField(*px_per_m);
}

PlanRecord made_plan(const PlanOptions& options, const PlanCommandParams& params) {
  Sketch sketch = read_drawing_input(options.map, options.drawing);
  const StartPose start = place_from(options.start, "--start");
  const ScaleField scale = scale_field(options, sketch, start, params.scales);
  const Clock::time_point begin = Clock::now();
  const Planner planner(sketch, scale, params.planning);
  PlanRecord record{.sketch = std::move(sketch), .space = planner.space()};
  record.prepare_ms = ms_since(begin);
  record.params = params.planning;
  record.query = {.start_in_sketch = start.place_in_sketch,
                  .goal_in_sketch = place_from(options.goal, "--goal").place_in_sketch,
                  .start_heading_rad = heading_of(options.start, "--start"),
                  .goal_heading_rad = heading_of(options.goal, "--goal")};
  const Clock::time_point asked = Clock::now();
  PlanWatch watch{.found = [&](const Plan& better) {
    record.stages.push_back({better.source, better.figures, ms_since(asked)});
  }};
  if (options.deadline_ms > 0.0) {
    watch.out_of_time = [&] { return ms_since(asked) > options.deadline_ms; };
  }
  record.plan = planner.plan(record.query, options.seed, watch);
  record.ms = ms_since(asked);
  return record;
}

RunDescription description_of(const PlanOptions& options, const PlanCommandParams& params,
                              const Sketch& sketch) {
  RunDescription description{
      .command = "plan",
      .seed = options.seed,
      .inputs = {{"map", options.map.string()}, {"start", options.start}, {"goal", options.goal}},
      .parameters = to_config(params),
      .drawing = PictureSize{.width_px = sketch.width_px(), .height_px = sketch.height_px()}};
  if (!options.scales.empty()) {
    description.inputs.emplace_back("scales", options.scales.string());
  }
  description.inputs.emplace_back("deadline-ms", number_text(options.deadline_ms));
  for (const auto& [option, value] : given_drawing_options(options.drawing)) {
    description.inputs.emplace_back(option, value);
  }
  return description;
}

/// What is wrong and what to do.
std::string complaint_of(const PlanRecord& record) {
  const Plan& plan = record.plan;
  const bool at_start =
      plan.status == Plan::Status::StartBlocked || plan.status == Plan::Status::StartOutside;
  std::string text(name_of(plan.status));
  if (const auto& nearest = plan.nearest_free_in_sketch) {
    text += fmt::format("; the nearest place where the robot fits is --{} {:.1f},{:.1f}",
                        at_start ? "start" : "goal", nearest->x(), nearest->y());
  } else if (plan.status == Plan::Status::NoPath) {
    text += fmt::format(
        ": the robot needs {:.2f} m on each side; where a door may be drawn shut, allow crossings "
        "with --planning.crossing_cost_m",
        record.params.body.clear_m());
  } else if (plan.status == Plan::Status::TooTight) {
    text += fmt::format(
        ": a robot that turns on the spot gets there, one with a turning radius of {:.2f} m does "
        "not; give a smaller --planning.turning_radius_m, or leave the heading at --start or "
        "--goal open",
        record.params.turning_radius_m);
  } else if (plan.status == Plan::Status::OutOfTime) {
    text += "; give a longer --deadline-ms, or 0 for none";
  }
  return text;
}

std::string summary_text(const PlanRecord& record) {
  const PathFigures& figures = record.plan.figures;
  return fmt::format(
      "{}: {:.2f} m, {:.2f} m from strokes at least, {:.2f} m on average, {} strokes crossed\n"
      "first path after {:.1f} ms, all {:.1f} ms, drawing {:.1f} ms\n",
      name_of(record.plan.status), figures.length_m, figures.least_clearance_m,
      figures.mean_clearance_m, figures.crossings,
      record.stages.empty() ? 0.0 : record.stages.front().ms, record.ms, record.prepare_ms);
}

void add_algorithm_options(CLI::App& command, PlanOptions& options) {
  const auto option = [&](const std::string& flag, auto& value, const std::string& help) {
    return command.add_option(flag, value, help)->group(kAlgorithmGroup);
  };
  option("--map", options.map, "The drawing: PNG, JPEG, PGM, or a map_server YAML")
      ->required()
      ->type_name("DRAWING");
  add_drawing_options(command, options.drawing, "Of the drawing");
  option("--start", options.start,
         "Where the robot is: x right and y up from the lower left corner in px; the heading "
         "matters with a turning radius alone, px per m tell how large the robot is")
      ->required()
      ->check([](const std::string& text) { return place_from(text, "--start"), std::string(); })
      ->type_name("X,Y[,HEADING_DEG[,PX_PER_M]]");
  option("--goal", options.goal,
         "Where it wants to be; with a turning radius, a heading may be asked for")
      ->required()
      ->check([](const std::string& text) { return place_from(text, "--goal"), std::string(); })
      ->type_name("X,Y[,HEADING_DEG]");
  option("--scales", options.scales,
         "trajectory.csv of a run localized in this drawing: how large a metre is where")
      ->type_name("FILE.csv");
  option("--deadline-ms", options.deadline_ms,
         "The best way found until then is taken; 0: only --planning.improvements ends the work, "
         "so that the same seed gives the same way")
      ->check(non_negative_number())
      ->capture_default_str();
  option("--seed", options.seed, "Of the random trees and changes")
      ->check(whole_number())
      ->capture_default_str();
}

}  // namespace

void run_plan(const PlanOptions& options) {
  const auto params = parameters_from<PlanCommandParams>(options.parameters);
  OutputFolder out(options.out, options.force);
  const PlanRecord record = made_plan(options, params);
  write_atomically(out / "metrics.json", to_json(record));
  write_atomically(out / "path.csv", path_csv(record));
  write_atomically(out / "picture.png", picture_png(record));
  write_atomically(out / "report.html", report_html(record));
  write_atomically(out / "run.yaml", run_file_text(description_of(options, params, record.sketch)));
  out.commit();
  if (!record.plan.found()) {
    throw std::runtime_error(options.map.string() + ": " + complaint_of(record));
  }
  std::cout << summary_text(record) << "report: " << (out.target() / "report.html").string()
            << "\n";
}

void add_plan_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "plan", "Find a way in a drawing that keeps off its strokes in real metres.");
  const auto options = std::make_shared<PlanOptions>();
  add_algorithm_options(*command, *options);
  add_parameter_options(*command, to_config(PlanCommandParams{}), options->parameters);
  command
      ->add_option("--out", options->out,
                   "Folder for metrics.json, path.csv, picture.png, report.html and run.yaml")
      ->required()
      ->type_name("DIR")
      ->group(kOutputGroup);
  command->add_flag("--force", options->force, "Replace an earlier result")->group(kOutputGroup);
  command->callback([options] { run_plan(*options); });
}

}  // namespace sketchloc
