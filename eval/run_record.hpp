#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "datasets/reference.hpp"
#include "datasets/run.hpp"
#include "datasets/sketch.hpp"
#include "eval/run_metrics.hpp"
#include "eval/sketch_errors.hpp"
#include "filter/step_report.hpp"
#include "smoothing/drawing_spline.hpp"
#include "smoothing/keyframe.hpp"

namespace sketchloc {

/// A particle as pictures need it, in the sketch frame.
struct SnapshotParticle {
  float x_px = 0.0F;
  float y_px = 0.0F;
  float yaw_rad = 0.0F;
  float weight = 0.0F;
};

/// Particles (or a fair sample of them) after one step.
struct ParticleSnapshot {
  std::size_t step = 0;  ///< index of the scan in the run
  std::vector<SnapshotParticle> particles;
};

/// One input of a run as the report names it, e.g. {"drawing", "kitchen.png"}.
struct NamedText {
  std::string name;
  std::string text;
};

/// All that is told about one run: the input of report_html() and picture_png().
struct RunRecord {
  std::string title;
  std::uint64_t seed = 0;
  std::string commit;
  std::vector<NamedText> inputs;
  std::string parameters;  ///< as YAML, shown as it is

  Sketch sketch;
  Run run;                                   ///< may be empty: then no scans are shown
  std::vector<StepReport> steps;             ///< in the order of the run
  std::vector<StepReport> filtered = {};     ///< of a run that was smoothed: the filter's own steps
  KeyframeRun keyframes = {};                ///< what it was smoothed by
  std::optional<DrawingSpline> spline = {};  ///< of the whole drawing, where one was found
  std::vector<ParticleSnapshot> snapshots;   ///< steps increasing; may be empty

  std::optional<Reference> reference;
  std::vector<Reference> alternatives;  ///< other readings of the drawing, accepted too
  LossDefinition loss;
  std::optional<RunCost> cost;
};

/// The errors of the run; empty without a reference.
std::vector<StepError> step_errors(const RunRecord& record);

RunMetrics measure_run(const RunRecord& record);

}  // namespace sketchloc
