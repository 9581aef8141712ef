#include "apps/result_files.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <string>

#include "datasets/io/atomic_file.hpp"
#include "datasets/io/trajectory_io.hpp"
#include "eval/drawing_overlay.hpp"
#include "eval/drawing_spline_io.hpp"
#include "eval/keyframe_io.hpp"
#include "eval/picture.hpp"
#include "eval/report.hpp"
#include "eval/step_table.hpp"
#include "motion/angles.hpp"

namespace sketchloc {
namespace {

/// What cannot be drawn must not cost the figures.
void write_for_people(const OutputFolder& out, const std::string& name,
                      const std::function<std::string()>& content) {
  try {
    write_atomically(out / name, content());
  } catch (const std::exception& error) {
    spdlog::warn("{} is missing: {}", name, error.what());
  }
}

}  // namespace

SketchTrajectory trajectory_of(const std::vector<StepReport>& steps) {
  SketchTrajectory trajectory;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool last_at_its_time = i + 1 == steps.size() || steps[i + 1].time_s > steps[i].time_s;
    if (last_at_its_time) {
      trajectory.append(steps[i].time_s, steps[i].estimate.sketch_from_robot);
    }
  }
  return trajectory;
}

Reference as_reference(const std::vector<AlternativePose>& alternative, const Reference& first) {
  Reference reference;
  for (const AlternativePose& pose : alternative) {
    const auto same = std::ranges::find(first.poses, pose.step, &ReferencePose::step);
    if (same != first.poses.end()) {
      reference.poses.push_back({.step = pose.step,
                                 .time_s = pose.time_s,
                                 .sketch_from_robot = pose.sketch_from_robot,
                                 .uncertainty_m = same->uncertainty_m,
                                 .scored = same->scored});
    }
  }
  return reference;
}

std::string error_text(const SketchErrors& errors) {
  return fmt::format(
      "within 1 m / 2 m of the reference: {:.0f} % / {:.0f} % of {} steps\n"
      "median error: {:.2f} m, {:.1f} deg; 90 % below {:.2f} m\n"
      "first lost: {}; at the end: {}\n",
      100.0 * errors.share_within_1_m, 100.0 * errors.share_within_2_m, errors.scored,
      errors.translation_m->median, deg_from_rad(errors.heading_rad->median),
      errors.translation_m->p90,
      errors.first_loss_s ? fmt::format("after {:.0f} s", *errors.first_loss_s) : "never",
      errors.lost_at_end ? "lost" : "located");
}

void write_result_files(const OutputFolder& out, const RunRecord& record,
                        const RunDescription& description) {
  write_tum(out / "trajectory.tum", trajectory_of(record.steps));
  write_atomically(out / "trajectory.csv", step_table_csv(record.steps));
  if (!record.filtered.empty()) {
    write_atomically(out / "filtered.csv", step_table_csv(record.filtered));
  }
  if (!record.keyframes.keyframes.empty()) {
    write_atomically(out / "keyframes.jsonl", to_jsonl(record.keyframes));
  }
  if (record.spline) {
    write_atomically(out / "spline.json", to_json(*record.spline, record.keyframes));
  }
  write_atomically(out / "metrics.json", to_json(measure_run(record)));
  write_atomically(out / "run.yaml", run_file_text(description));
  write_for_people(out, "report.html", [&] { return report_html(record); });
  write_for_people(out, "picture.png", [&] { return picture_png(record); });
  if (record.spline) {
    write_for_people(out, "overlay.png", [&] { return overlay_png(record); });
  }
}

std::string summary_text(const RunRecord& record) {
  const RunMetrics metrics = measure_run(record);
  std::string text =
      metrics.errors && metrics.errors->scored > 0 ? error_text(*metrics.errors) : std::string();
  text += fmt::format("{} poses", metrics.poses);
  if (metrics.cost) {
    text += fmt::format(" in {:.1f} s, peak memory {:.0f} MB", metrics.cost->seconds,
                        metrics.cost->peak_memory_mb);
  }
  return text + "\n";
}

}  // namespace sketchloc
