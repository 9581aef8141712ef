#include "apps/evaluate_log.hpp"

#include <spdlog/fmt/fmt.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "apps/statistics_table.hpp"
#include "datasets/io/corrected_poses.hpp"
#include "datasets/io/reference_io.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/sim/scan_agreement.hpp"
#include "motion/angles.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kIndent = 2;
constexpr std::array kStatusNames = {"first", "matched", "degenerate", "too_few_points",
                                     "rejected"};

std::string cells_of(const ErrorSummary& summary, int digits) {
  return fmt::format("{:.{}f} | {:.{}f} | {:.{}f} | {:.{}f}", summary.mean, digits, summary.median,
                     digits, summary.rmse, digits, summary.max, digits);
}

ErrorSummary rotation_deg(const PoseErrors& errors) {
  return scaled(*errors.rotation_rad, deg_from_rad(1.0));
}

std::string line_of(const OdometryErrors& row) {
  if (!row.errors.translation_m) {
    return fmt::format("| {} | {} | 0 | - | - | - | - | - | - | - | - |\n", row.reference,
                       row.odometry);
  }
  return fmt::format("| {} | {} | {} | {} | {} |\n", row.reference, row.odometry,
                     row.errors.translation_m->count, cells_of(*row.errors.translation_m, 3),
                     cells_of(rotation_deg(row.errors), 2));
}

std::string table_of(const OdometryComparison& found) {
  std::string table =
      "| against | odometry | pairs | mean m | median m | RMSE m | max m | mean deg | median deg | "
      "RMSE deg | max deg |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const OdometryErrors& row : found.rows) {
    table += line_of(row);
  }
  table += fmt::format("\n{} relations without a pose at one of their times; steps:",
                       found.unmatched_relations);
  for (std::size_t i = 0; i < kStatusNames.size(); ++i) {
    table += fmt::format(" {} {}", found.steps_by_status[i], kStatusNames[i]);
  }
  if (found.honesty) {
    table += fmt::format(
        "\nNEES of the increments (3 degrees of freedom): median {:.2f} (honest: 2.37), p90 {:.2f} "
        "(6.25), {:.1f} % in the 95 % ellipsoid",
        found.honesty->median_nees, found.honesty->p90_nees, 100.0 * found.honesty->share_in_95);
  }
  return table + "\n";
}

Json json_of(const ErrorSummary& summary) {
  return {{"mean", summary.mean},
          {"median", summary.median},
          {"rmse", summary.rmse},
          {"p90", summary.p90},
          {"max", summary.max}};
}

std::string json_text(const OdometryComparison& found) {
  Json json;
  for (const OdometryErrors& row : found.rows) {
    Json entry = {{"odometry", row.odometry}, {"reference", row.reference}, {"pairs", 0}};
    if (row.errors.translation_m) {
      entry["pairs"] = row.errors.translation_m->count;
      entry["translation_error_m"] = json_of(*row.errors.translation_m);
      entry["rotation_error_deg"] = json_of(rotation_deg(row.errors));
    }
    json["errors"].push_back(entry);
  }
  json["unmatched_relations"] = found.unmatched_relations;
  for (std::size_t i = 0; i < kStatusNames.size(); ++i) {
    json["steps"][kStatusNames[i]] = found.steps_by_status[i];
  }
  if (found.honesty) {
    json["increment_nees"] = {{"median", found.honesty->median_nees},
                              {"p90", found.honesty->p90_nees},
                              {"share_inside_95", found.honesty->share_in_95}};
  }
  return json.dump(kIndent) + "\n";
}

std::string json_text(const ScanAgreement& agreement) {
  const Json json = {{"returns", agreement.returns},
                     {"median_log_ratio", agreement.median_log_ratio},
                     {"log_ratio_p25", agreement.log_ratio_p25},
                     {"log_ratio_p75", agreement.log_ratio_p75},
                     {"share_within_0_1", agreement.share_within_0_1},
                     {"share_within_0_3", agreement.share_within_0_3},
                     {"share_within_0_6", agreement.share_within_0_6},
                     {"share_short", agreement.share_short},
                     {"share_long", agreement.share_long},
                     {"share_near_stroke", agreement.share_near_stroke},
                     {"share_near_stroke_mirrored", agreement.share_near_stroke_mirrored}};
  return json.dump(kIndent) + "\n";
}

}  // namespace

Evaluation evaluate_odometry(const fs::path& log, const fs::path& relations,
                             const OdometryComparisonParams& params) {
  const Run run = read_run(log);
  const MetricTrajectory corrected = read_corrected_poses(log);
  if (corrected.size() != run.steps.size()) {
    throw std::runtime_error(
        fmt::format("{}: {} scans but {} corrected poses; expected a log that "
                    "has FLASER lines only",
                    log.string(), run.steps.size(), corrected.size()));
  }
  const std::vector<Relation> known =
      relations.empty() ? std::vector<Relation>{} : read_relations(relations);
  const OdometryComparison found = compare_odometry(run, corrected, known, params);
  return {.table = table_of(found), .json = json_text(found)};
}

Evaluation evaluate_scans(const fs::path& log, const Sketch& sketch, const fs::path& reference) {
  const Reference poses = read_reference(reference, sketch.height_px());
  const Run run = read_run(log);
  if (!poses.poses.empty() && poses.poses.back().step >= run.steps.size()) {
    throw std::runtime_error(fmt::format("{}: has a pose for scan {}, but {} has {} scans",
                                         reference.string(), poses.poses.back().step, log.string(),
                                         run.steps.size()));
  }
  const ScanAgreement agreement = measure_agreement(sketch, run, poses);
  if (agreement.returns == 0) {
    throw std::runtime_error(reference.string() +
                             ": no scored pose has a scan with a return between 0.1 m and 20 m");
  }
  return {.table = agreement_table(agreement), .json = json_text(agreement)};
}

}  // namespace sketchloc
