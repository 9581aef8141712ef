#include "apps/read_options.hpp"

#include <CLI/CLI.hpp>

#include "apps/program.hpp"

namespace sketchloc {

void add_read_options(CLI::App& command, RunReading& reading) {
  command
      .add_option("--max-range-m", reading.max_range_m,
                  "Ranges from here on are no returns; else what the log says")
      ->check(CLI::PositiveNumber)
      ->group(kAlgorithmGroup);
  command
      .add_flag("--allow-truncated", reading.allow_truncated,
                "Keep the whole lines of a log that ends in the middle of one")
      ->group(kAlgorithmGroup);
}

}  // namespace sketchloc
