#include "apps/read_options.hpp"

#include <CLI/CLI.hpp>

#include "apps/option_checks.hpp"
#include "apps/program.hpp"

namespace sketchloc {
namespace {

using Polarity = SketchReading::Polarity;

const std::map<std::string, Polarity> kPolarities = {{"dark-on-light", Polarity::DarkOnLight},
                                                     {"light-on-dark", Polarity::LightOnDark}};
const std::map<std::string, Sketch::Kind> kKinds = {
    {"strokes", Sketch::Kind::Strokes}, {"filled-free-space", Sketch::Kind::FilledFreeSpace}};

}  // namespace

void add_read_options(CLI::App& command, RunReading& reading) {
  command
      .add_option("--max-range-m", reading.max_range_m,
                  "Ranges from here on are no returns; else what the log says")
      ->check(positive_number())
      ->group(kAlgorithmGroup);
  command
      .add_flag("--allow-truncated", reading.allow_truncated,
                "Keep the whole lines of a log that ends in the middle of one")
      ->group(kAlgorithmGroup);
}

void add_drawing_options(CLI::App& command, SketchReading& reading, const std::string& of_what) {
  add_named_option(command, "--polarity", reading.polarity, kPolarities,
                   of_what + ": dark-on-light or light-on-dark; else found")
      ->group(kAlgorithmGroup);
  add_named_option(command, "--drawn", reading.kind, kKinds,
                   of_what + ": strokes or filled-free-space; else found")
      ->group(kAlgorithmGroup);
}

std::vector<std::pair<std::string, std::string>> given_drawing_options(
    const SketchReading& reading) {
  std::vector<std::pair<std::string, std::string>> given;
  if (reading.polarity) {
    given.emplace_back("polarity", name_of(kPolarities, *reading.polarity));
  }
  if (reading.kind) {
    given.emplace_back("drawn", name_of(kKinds, *reading.kind));
  }
  return given;
}

}  // namespace sketchloc
