#include "apps/convert_command.hpp"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
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
struct ConvertOptions {
  fs::path input;
  fs::path output;
  RunReading run;
  SketchReading drawing;
  bool force = false;
};

Run read_log(const ConvertOptions& options) {
  RunFile file = read_run_file(options.input, options.run);
  for (const std::string& note : file.notes) {
    spdlog::warn("{}: {}", options.input.string(), note);
  }
  return std::move(file.run);
}

/// Packed where the name ends in .gz.
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
  const Sketch sketch = read_any_drawing(options.input, options.drawing);
  write_sketch(options.output, sketch);
  std::cout << (sketch.kind == Sketch::Kind::Strokes ? "strokes" : "filled-free-space") << ", "
            << sketch.width_px() << " x " << sketch.height_px() << " px in "
            << options.output.string() << "\n";
}

struct Conversion {
  const char* extension;
  void (*convert)(const ConvertOptions&);
};

constexpr std::array kConversions = {
    Conversion{".jsonl", convert_to_json_lines}, Conversion{".jsonl.gz", convert_to_json_lines},
    Conversion{".tum", convert_to_odometry}, Conversion{".png", convert_to_picture}};

void convert(const ConvertOptions& options) {
  const std::string name = options.output.filename();
  const auto found = std::ranges::find_if(kConversions, [&](const Conversion& conversion) {
    return name.ends_with(conversion.extension);
  });
  if (found == kConversions.end()) {
    throw std::invalid_argument(options.output.string() +
                                ": the name must end in .jsonl or .jsonl.gz (log), .tum (its "
                                "odometry) or .png (drawing)");
  }
  if (fs::exists(options.output) && fs::equivalent(options.input, options.output)) {
    throw std::invalid_argument(options.output.string() +
                                ": is the input itself; choose another name for the output");
  }
  if (!options.force && fs::exists(options.output)) {
    throw std::invalid_argument(options.output.string() +
                                ": it is there already; give --force to replace it");
  }
  found->convert(options);
}

void add_algorithm_options(CLI::App& command, ConvertOptions& options) {
  add_read_options(command, options.run);
  add_drawing_options(command, options.drawing, "Of the drawing");
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
  command
      ->add_option("output", options->output, "File that ends in .jsonl, .jsonl.gz, .tum or .png")
      ->type_name("FILE")
      ->required();
  add_algorithm_options(*command, *options);
  command->add_flag("--force", options->force, "Replace the output")->group(kOutputGroup);
  command->callback([options] { convert(*options); });
}

}  // namespace sketchloc
