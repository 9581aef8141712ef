#include "apps/track_lines.hpp"

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

namespace sketchloc {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(Refusal refusal) {
  switch (refusal) {
    case Refusal::Duplicate:
      return "duplicate";
    case Refusal::OutOfOrder:
      return "out_of_order";
    case Refusal::NoOdometry:
      return "no_odometry";
    case Refusal::Late:
      return "late";
  }
  return "";
}

const char* name_of(TrackedScan::Status status) {
  switch (status) {
    case TrackedScan::Status::Tracked:
      return "tracked";
    case TrackedScan::Status::NotStarted:
      return "not_started";
    case TrackedScan::Status::Refused:
      return "refused";
  }
  return "";
}

double ms(double seconds) { return 1e3 * seconds; }

Json matrix(const Eigen::Matrix4d& values) {
  Json rows = Json::array();
  for (Eigen::Index row = 0; row < values.rows(); ++row) {
    rows.push_back({values(row, 0), values(row, 1), values(row, 2), values(row, 3)});
  }
  return rows;
}

Json pose_json(const Sim2& sketch_from_robot) {
  return {{"x_px", sketch_from_robot.x()},
          {"y_px", sketch_from_robot.y()},
          {"heading_rad", sketch_from_robot.yaw_rad()},
          {"scale_px_per_m", sketch_from_robot.scale()}};
}

/// What the filter believes. Whether it is right, as far as the filter knows, belongs here too.
void add_belief(Json& line, const StepReport& report) {
  const Estimate& estimate = report.estimate;
  line["pose"] = pose_json(estimate.sketch_from_robot);
  line["covariance"] = matrix(estimate.covariance);
  line["modes"] = estimate.modes.size();
  line["mode_weight"] = estimate.modes.empty() ? 0.0 : estimate.modes.front().weight;
}

void add_work(Json& line, const TrackedScan& scan) {
  const StepReport& report = scan.report;
  line["updated"] = report.updated;
  line["registration"] = report.registered  ? "used"
                         : report.looked    ? "tried"
                         : report.held_back ? "held_back"
                                            : "not_due";
  line["resampled"] = report.resampled;
  line["particles"] = report.particles;
  line["effective_particles"] = report.effective_particles;
  line["injected_share"] = report.injected_share;
}

/// What a lack of time took away; nothing: null.
Json degradation(const TrackedScan& scan) {
  Json degraded;
  if (scan.report.limited) {
    degraded["particles_at_most"] = scan.plan.budget.max_particles;
  }
  if (scan.report.held_back) {
    degraded["registration_every"] = scan.plan.register_every;
  }
  return degraded;
}

Json quantiles(const Durations& durations) {
  if (durations.count() == 0) {
    return nullptr;
  }
  return {{"count", durations.count()},
          {"mean", ms(durations.mean_s())},
          {"p50", ms(durations.quantile_s(0.5))},
          {"p90", ms(durations.quantile_s(0.9))},
          {"p99", ms(durations.quantile_s(0.99))},
          {"max", ms(durations.max_s())}};
}

Json input_counts(const TrackEnd& end) {
  const IntakeCounts& in = end.intake;
  return {{"messages", in.messages},
          {"malformed", end.tally.malformed},
          {"with_nan", end.tally.with_nan},
          {"odometry_out_of_order", in.odometry_out_of_order},
          {"odometry_jumps", in.odometry_jumps},
          {"odometry_held", in.odometry_held},
          {"gaps", in.gaps},
          {"clock_set_back", in.clock_set_back},
          {"beam_count_changes", in.beam_count_changes},
          {"blind_scans", in.blind_scans}};
}

/// Scans that were still waiting when the end came.
std::uint64_t scans_left(const TrackEnd& end) {
  const IntakeCounts& in = end.intake;
  return in.scans - end.tally.tracked - end.tally.not_started - end.tally.late -
         in.duplicate_scans - in.out_of_order_scans - in.scans_without_odometry;
}

}  // namespace

std::string scan_line(const TrackedScan& scan) {
  Json line;
  line["time_s"] = scan.time_s;
  line["status"] = name_of(scan.status);
  if (scan.refusal) {
    line["why"] = name_of(*scan.refusal);
  }
  if (scan.status == TrackedScan::Status::Tracked) {
    line["step"] = scan.report.step;
    add_belief(line, scan.report);
    add_work(line, scan);
    line["unmeasured_s"] = scan.unmeasured_s ? Json(*scan.unmeasured_s) : Json();
    line["degraded"] = degradation(scan);
    line["missed_deadline"] = scan.missed_deadline;
    line["work_ms"] = {{"odometry", ms(scan.odometry_s)}, {"filter", ms(scan.localizer_s)}};
  }
  line["latency_ms"] = ms(scan.latency_s);
  return line.dump();
}

std::string lagged_line(const LaggedPose& lagged) {
  return Json{{"time_s", lagged.time_s},
              {"status", "smoothed"},
              {"step", lagged.step},
              {"pose", pose_json(lagged.pose.sketch_from_robot)},
              {"covariance", matrix(lagged.pose.covariance)},
              {"localized_probability", lagged.pose.probability},
              {"lag_m", lagged.way_m}}
      .dump();
}

std::string summary_line(const TrackEnd& end) {
  const TrackTally& tally = end.tally;
  Json summary;
  summary["end"] = end.end;
  summary["seconds"] = end.seconds;
  summary["scans"] = {{"all", end.intake.scans},
                      {"tracked", tally.tracked},
                      {"not_started", tally.not_started},
                      {"duplicate", end.intake.duplicate_scans},
                      {"out_of_order", end.intake.out_of_order_scans},
                      {"no_odometry", end.intake.scans_without_odometry},
                      {"late", tally.late},
                      {"left", scans_left(end)}};
  summary["input"] = input_counts(end);
  summary["deadline"] = {{"missed", tally.missed_deadlines},
                         {"with_fewer_particles", tally.fewer_particles},
                         {"registrations_held_back", tally.held_back},
                         {"registrations", tally.registrations}};
  summary["latency_ms"] = quantiles(tally.latency);
  summary["work_ms"] = {{"odometry", quantiles(tally.odometry)},
                        {"filter", quantiles(tally.localizer_without_registration)},
                        {"filter_with_registration", quantiles(tally.localizer_with_registration)}};
  summary["states_written"] = end.states_written;
  return Json({{"summary", summary}}).dump();
}

}  // namespace sketchloc
