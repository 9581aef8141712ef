#include "apps/smooth_run.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/output_folder.hpp"
#include "apps/result_files.hpp"
#include "apps/run_file.hpp"
#include "datasets/io/atomic_file.hpp"
#include "datasets/io/trajectory_io.hpp"
#include "eval/drawing_spline_io.hpp"
#include "eval/keyframe_io.hpp"
#include "eval/smoothed_localization.hpp"
#include "eval/step_table.hpp"
#include "smoothing/smooth.hpp"

namespace sketchloc {
namespace {

std::vector<StepReport> reports_of(const KeyframeRun& run, const SmoothedRun& smoothed) {
  std::vector<StepReport> reports;
  for (std::size_t k = 0; k < run.keyframes.size(); ++k) {
    const SmoothedPose& pose = smoothed.poses[k];
    StepReport& report = reports.emplace_back();
    report.step = run.keyframes[k].step;
    report.time_s = run.keyframes[k].time_s;
    report = smoothed_report(report, pose);
  }
  return reports;
}

}  // namespace

void smooth_run(const SmoothOptions& options, const SmoothParams& params) {
  using Clock = std::chrono::steady_clock;
  OutputFolder out(options.out, options.force);
  const KeyframeRun run = read_keyframes(options.run / "keyframes.jsonl");
  const Clock::time_point begin = Clock::now();
  const SmoothedRun smoothed = smooth(run, params.smoothing);
  const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  if (smoothed.status == SmoothedRun::Status::NoEvidence) {
    throw std::runtime_error((options.run / "keyframes.jsonl").string() +
                             ": no keyframe has a hypothesis; nothing says where the robot was");
  }
  const std::vector<StepReport> reports = reports_of(run, smoothed);
  write_tum(out / "trajectory.tum", trajectory_of(reports));
  write_atomically(out / "trajectory.csv", step_table_csv(reports));
  if (const auto spline = spline_or_warning(run, smoothed.poses, params.spline, options.run)) {
    write_atomically(out / "spline.json", to_json(*spline, run));
  }
  write_atomically(out / "run.yaml", run_file_text({.command = "smooth",
                                                    .seed = std::nullopt,
                                                    .inputs = {{"run", options.run.string()}},
                                                    .parameters = to_config(params)}));
  out.commit();
  std::cout << fmt::format("{} keyframes, {:.3f} s\n", run.keyframes.size(), seconds)
            << "trajectory: " << (out.target() / "trajectory.csv").string() << "\n";
}

std::optional<DrawingSpline> spline_or_warning(const KeyframeRun& run,
                                               std::span<const SmoothedPose> smoothed,
                                               const DrawingSplineParams& params,
                                               const std::filesystem::path& of_run) {
  auto spline = fit_drawing_spline(run, smoothed, params);
  if (!spline) {
    spdlog::warn(
        "{}: no spline.json: the way is shorter than the {} m between control points "
        "(spline.spacing_m), or the smoothed poses fit no map that does not fold",
        of_run.string(), params.spacing_m);
  }
  return spline;
}

}  // namespace sketchloc
