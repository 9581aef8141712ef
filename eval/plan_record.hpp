#pragma once

#include <optional>
#include <string>
#include <vector>

#include "datasets/sketch.hpp"
#include "planning/planner.hpp"

namespace sketchloc {

/// A way that was better than those before.
struct PlanStage {
  Plan::Source source = Plan::Source::Trees;
  PathFigures figures = {};
  double ms = 0.0;  ///< since the question, wall clock
};

/// A question to the planner and its answer.
struct PlanRecord {
  Sketch sketch = {};
  FreeSpace space;
  PlanQuery query = {};
  PlanParams params = {};
  Plan plan = {};
  std::vector<PlanStage> stages = {};
  double prepare_ms = 0.0;  ///< once for a drawing, wall clock
  double ms = 0.0;          ///< for the question, wall clock
};

/// `metrics.json` and `path.csv`, see docs/formats.md.
std::string to_json(const PlanRecord& record);
std::string path_csv(const PlanRecord& record);

/// `picture.png`: the way over the drawing, coloured by its clearance, as the bytes of a PNG file.
std::string picture_png(const PlanRecord& record);

/// `report.html`: a page of its own.
std::string report_html(const PlanRecord& record);

}  // namespace sketchloc
