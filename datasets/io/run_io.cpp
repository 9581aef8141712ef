#include "datasets/io/run_io.hpp"

#include "datasets/io/detail/carmen.hpp"
#include "datasets/io/detail/whole_lines.hpp"
#include "motion/validate.hpp"

namespace sketchloc {

void validate(const RunReading& reading) {
  if (reading.max_range_m) {
    require_above("max_range_m", *reading.max_range_m, 0.0);
  }
  require_above("max_line_bytes", static_cast<double>(reading.max_line_bytes), 0.0);
  require_above("max_total_bytes", static_cast<double>(reading.max_total_bytes), 0.0);
}

RunFile read_run_file(const std::filesystem::path& log, const RunReading& reading) {
  validate(reading);
  detail::LineReader lines(log, detail::text_limits(reading));
  return detail::read_carmen_lines(lines, reading);
}

Run read_run(const std::filesystem::path& log, const RunReading& reading) {
  return read_run_file(log, reading).run;
}

}  // namespace sketchloc
