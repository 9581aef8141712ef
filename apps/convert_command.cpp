#include "apps/convert_command.hpp"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "apps/program.hpp"
#include "apps/read_options.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_io.hpp"
#include "datasets/io/sketch_writer.hpp"
#include "datasets/io/trajectory_io.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;
using Polarity = SketchReading::Polarity;

const std::map<std::string, Polarity> kPolarities = {{"dark-on-light", Polarity::DarkOnLight},
                                                     {"light-on-dark", Polarity::LightOnDark}};
const std::map<std::string, Sketch::Kind> kKinds = {
    {"strokes", Sketch::Kind::Strokes}, {"filled-free-space", Sketch::Kind::FilledFreeSpace}};

struct ConvertOptions {
  fs::path input;
  fs::path output;
  RunReading run;
  std::optional<std::string> polarity;
  std::optional<std::string> drawn;
  bool force = false;
};

SketchReading sketch_reading(const ConvertOptions& options) {
  SketchReading reading;
  if (options.polarity) {
    reading.polarity = kPolarities.at(*options.polarity);
  }
  if (options.drawn) {
    reading.kind = kKinds.at(*options.drawn);
  }
  return reading;
}

Run read_log(const ConvertOptions& options) {
  RunFile file = read_run_file(options.input, options.run);
  for (const std::string& note : file.notes) {
    spdlog::warn("{}: {}", options.input.string(), note);
  }
  return std::move(file.run);
}

void convert_to_json_lines(const ConvertOptions& options) {
  const Run run = read_log(options);
  write_jsonl(options.output, run);
  std::cout << run.steps.size() << " scans in " << options.output.string() << "\n";
}

/// Of steps at the same time, the first one.
void convert_to_odometry(const ConvertOptions& options) {
  MetricTrajectory odometry;
  for (const RunStep& step : read_log(options).steps) {
    if (odometry.empty() || step.scan.time_s > odometry[odometry.size() - 1].time_s) {
      odometry.append(step.scan.time_s, step.odom_from_robot);
    }
  }
  write_tum(options.output, odometry);
  std::cout << odometry.size() << " poses of the odometry in " << options.output.string() << "\n";
}

void convert_to_picture(const ConvertOptions& options) {
  const Sketch sketch = read_any_drawing(options.input, sketch_reading(options));
  write_sketch(options.output, sketch);
  std::cout << (sketch.kind == Sketch::Kind::Strokes ? "strokes" : "filled-free-space") << ", "
            << sketch.width_px() << " x " << sketch.height_px() << " px in "
            << options.output.string() << "\n";
}

struct Conversion {
  const char* extension;
  void (*convert)(const ConvertOptions&);
};

constexpr std::array kConversions = {Conversion{".jsonl", convert_to_json_lines},
                                     Conversion{".tum", convert_to_odometry},
                                     Conversion{".png", convert_to_picture}};

void convert(const ConvertOptions& options) {
  const std::string extension = options.output.extension();
  const auto found = std::ranges::find(kConversions, extension, &Conversion::extension);
  if (found == kConversions.end()) {
    throw std::invalid_argument(options.output.string() +
                                ": the name must end in .jsonl (log), .tum (its odometry) or .png "
                                "(drawing)");
  }
  if (!options.force && fs::exists(options.output)) {
    throw std::invalid_argument(options.output.string() +
                                ": it is there already; give --force to replace it");
  }
  found->convert(options);
}

void add_algorithm_options(CLI::App& command, ConvertOptions& options) {
  add_read_options(command, options.run);
  command.add_option("--polarity", options.polarity, "Of the drawing; else found")
      ->check(CLI::IsMember(&kPolarities))
      ->group(kAlgorithmGroup);
  command.add_option("--drawn", options.drawn, "What the person drew; else found")
      ->check(CLI::IsMember(&kKinds))
      ->group(kAlgorithmGroup);
}

}  // namespace

void add_convert_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "convert",
      "Convert a log (CARMEN, JSON lines) to JSON lines or its odometry to TUM, or a "
      "drawing (picture, map_server) to what is read as obstacles.");
  const auto options = std::make_shared<ConvertOptions>();
  command->add_option("input", options->input, "Log or drawing")
      ->check(CLI::ExistingFile)
      ->type_name("FILE")
      ->required();
  command->add_option("output", options->output, "File that ends in .jsonl, .tum or .png")
      ->type_name("FILE")
      ->required();
  add_algorithm_options(*command, *options);
  command->add_flag("--force", options->force, "Replace the output")->group(kOutputGroup);
  command->callback([options] { convert(*options); });
}

}  // namespace sketchloc
