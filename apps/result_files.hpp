#pragma once

#include <string>
#include <vector>

#include "apps/output_folder.hpp"
#include "apps/run_file.hpp"
#include "datasets/io/reference_io.hpp"
#include "eval/run_record.hpp"
#include "motion/trajectory.hpp"

namespace sketchloc {

/// Another reading of the drawing as a reference of its own; uncertainties and scored steps are
/// those of the first reference.
Reference as_reference(const std::vector<AlternativePose>& alternative, const Reference& first);

/// trajectory.tum, trajectory.csv, metrics.json, report.html, picture.png and run.yaml; of a run
/// that was smoothed keyframes.jsonl and filtered.csv too.
void write_result_files(const OutputFolder& out, const RunRecord& record,
                        const RunDescription& description);

/// The errors in a few lines for the terminal; needs a scored step.
std::string error_text(const SketchErrors& errors);

/// What the terminal says of a run: a few lines.
std::string summary_text(const RunRecord& record);

/// Times of a log need not increase strictly, those of a trajectory do: of poses at one time the
/// last counts.
SketchTrajectory trajectory_of(const std::vector<StepReport>& steps);

}  // namespace sketchloc
