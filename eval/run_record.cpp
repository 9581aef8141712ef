#include "eval/run_record.hpp"

namespace sketchloc {

std::vector<StepError> step_errors(const RunRecord& record) {
  if (!record.reference) {
    return {};
  }
  return step_errors(record.steps, *record.reference, record.alternatives);
}

RunMetrics measure_run(const RunRecord& record) {
  RunMetrics metrics{.poses = record.steps.size(), .errors = {}, .cost = record.cost};
  if (record.reference) {
    metrics.errors = summarize_sketch_errors(step_errors(record), record.loss);
  }
  return metrics;
}

}  // namespace sketchloc
