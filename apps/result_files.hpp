#pragma once

#include <string>
#include <vector>

#include "apps/output_folder.hpp"
#include "apps/run_file.hpp"
#include "datasets/io/reference_io.hpp"
#include "eval/run_record.hpp"

namespace sketchloc {

/// Another reading of the drawing as a reference of its own; uncertainties and scored steps are
/// those of the first reference.
Reference as_reference(const std::vector<AlternativePose>& alternative, const Reference& first);

/// trajectory.tum, trajectory.csv, metrics.json, report.html, picture.png and run.yaml.
void write_result_files(const OutputFolder& out, const RunRecord& record,
                        const RunDescription& description);

/// The errors in a few lines for the terminal; needs a scored step.
std::string error_text(const SketchErrors& errors);

/// What the terminal says of a run: a few lines.
std::string summary_text(const RunRecord& record);

}  // namespace sketchloc
