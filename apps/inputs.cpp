#include "apps/inputs.hpp"

#include <spdlog/spdlog.h>

#include <stdexcept>
#include <utility>

#include "apps/input_checks.hpp"
#include "datasets/io/reference_io.hpp"

namespace sketchloc {

void warn_of(const std::filesystem::path& file, const std::vector<std::string>& doubts) {
  for (const std::string& doubt : doubts) {
    spdlog::warn("{}: {}", file.string(), doubt);
  }
}

Sketch read_drawing_input(const std::filesystem::path& drawing, const SketchReading& reading) {
  Sketch sketch = read_any_drawing(drawing, reading);
  warn_of(drawing, doubts_about(sketch));
  return sketch;
}

Run read_log_input(const std::filesystem::path& log, const RunReading& reading) {
  RunFile file = read_run_file(log, reading);
  for (const std::string& note : file.notes) {
    spdlog::info("{}", note);
  }
  warn_of(log, doubts_about(file.run));
  return std::move(file.run);
}

std::vector<double> scan_times_s(const Run& run) {
  std::vector<double> times_s;
  for (const RunStep& step : run.steps) {
    times_s.push_back(step.scan.time_s);
  }
  return times_s;
}

Reference read_reference_input(const std::filesystem::path& csv, int sketch_height_px,
                               const NamedRun& run) {
  Reference reference = read_reference(csv, sketch_height_px);
  if (is_of_another_run(reference, scan_times_s(run.run))) {
    throw std::runtime_error(csv.string() + ": its times are not those of " + run.log.string() +
                             "; give the reference of this log");
  }
  return reference;
}

}  // namespace sketchloc
