#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "filter/step_report.hpp"

namespace sketchloc {

/// The text of `trajectory.csv`: one line per step with pose, covariance and what the filter did.
/// Columns: docs/formats.md.
std::string step_table_csv(std::span<const StepReport> steps);

/// Reads such a file, plain or gzip, with at least one step. The modes beside the first are not in
/// it. Throws std::runtime_error with
/// file, line and column, what was expected and what was found.
std::vector<StepReport> read_step_table(const std::filesystem::path& csv);

}  // namespace sketchloc
