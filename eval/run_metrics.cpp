#include "eval/run_metrics.hpp"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "motion/angles.hpp"

namespace sketchloc {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const std::optional<ErrorSummary>& summary) {
  if (!summary) {
    return nullptr;
  }
  return {{"mean", summary->mean},
          {"median", summary->median},
          {"rmse", summary->rmse},
          {"p90", summary->p90},
          {"max", summary->max}};
}

Json json_in_degrees(const std::optional<ErrorSummary>& radians) {
  return json_of(radians ? std::optional(scaled(*radians, deg_from_rad(1.0))) : std::nullopt);
}

Json json_of(const std::optional<NeesSummary>& nees) {
  if (!nees) {
    return nullptr;
  }
  return {{"mean", nees->mean},
          {"degrees_of_freedom", nees->degrees},
          {"mean_band_95", {nees->mean_band.low, nees->mean_band.high}},
          {"share_inside_95", nees->share_inside},
          {"steps", nees->count}};
}

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

/// One list of keys, with and without errors.
void add_errors(Json& json, const std::optional<SketchErrors>& errors) {
  const auto add = [&](const char* key, const auto& value_in) {
    json[key] = errors ? Json(value_in(*errors)) : Json(nullptr);
  };
  using Errors = const SketchErrors&;
  json["scored_poses"] = errors ? errors->scored : 0;
  add("share_within_1_m", [](Errors e) { return e.share_within_1_m; });
  add("share_within_2_m", [](Errors e) { return e.share_within_2_m; });
  add("share_within_reference_2_sigma",
      [](Errors e) { return or_null(e.share_within_uncertainty); });
  add("translation_error_m", [](Errors e) { return json_of(e.translation_m); });
  add("translation_error_px", [](Errors e) { return json_of(e.translation_px); });
  add("heading_error_deg", [](Errors e) { return json_in_degrees(e.heading_rad); });
  add("median_scale_ratio", [](Errors e) { return e.median_scale_ratio; });
  add("lost_at_end", [](Errors e) { return e.lost_at_end; });
  add("first_loss_s", [](Errors e) { return or_null(e.first_loss_s); });
  add("share_localized", [](Errors e) { return e.share_localized; });
  add("localized_probability_mean", [](Errors e) { return e.mean_localized_probability; });
  add("localized_brier", [](Errors e) { return e.localized_brier; });
  add("position_nees", [](Errors e) { return json_of(e.position_nees); });
}

[[noreturn]] void fail_to_read(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

Json parse(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) {
    fail_to_read(file, "cannot be read; expected the metrics.json of a run");
  }
  Json json = Json::parse(stream, nullptr, false);
  if (!json.is_object()) {
    fail_to_read(file, "is not the metrics.json of a run");
  }
  return json;
}

/// The value at a key, which must be there; null only where that means something.
const Json& field(const Json& json, const std::string& key, const std::filesystem::path& file) {
  const auto found = json.find(key);
  if (found == json.end()) {
    fail_to_read(file, key + " is missing; expected the metrics.json of a run in a drawing");
  }
  return *found;
}

double number_at(const Json& json, const std::string& key, const std::filesystem::path& file) {
  const Json& value = field(json, key, file);
  if (value.is_null()) {
    fail_to_read(file, key +
                           " is null: the run was compared with nothing; make it again with "
                           "--reference, or evaluate it with --run");
  }
  if (!value.is_number()) {
    fail_to_read(file, key + " must be a number, but it is " + value.dump());
  }
  return value.get<double>();
}

ErrorSummary median_at(const Json& json, const std::string& key,
                       const std::filesystem::path& file) {
  const Json& summary = field(json, key, file);
  if (!summary.is_object()) {
    fail_to_read(file, key + " must be a summary, but it is " + summary.dump());
  }
  return {.median = number_at(summary, "median", file)};
}

Json json_of(const RelativeErrors& relative) {
  Json json;
  if (const auto* by_frames = std::get_if<FrameDelta>(&relative.params.delta)) {
    json["delta_frames"] = by_frames->frames;
  } else {
    json["delta_m"] = std::get<PathDelta>(relative.params.delta).path_m;
  }
  json["pairs"] = relative.errors.translation_m ? relative.errors.translation_m->count : 0;
  json["translation_m"] = json_of(relative.errors.translation_m);
  json["rotation_deg"] = json_in_degrees(relative.errors.rotation_rad);
  return json;
}

PoseErrors absolute_errors_aligned(const MatchedPoses& poses, Alignment alignment) {
  const std::optional<MatchedPoses> aligned = align(poses, alignment);
  return aligned ? absolute_errors(*aligned) : PoseErrors{};
}

constexpr int kIndent = 2;

}  // namespace

std::string to_json(const RunMetrics& metrics) {
  Json json;
  json["poses"] = metrics.poses;
  const bool measured = metrics.errors && metrics.errors->scored > 0;
  add_errors(json, measured ? metrics.errors : std::nullopt);
  json["seconds"] = metrics.cost ? Json(metrics.cost->seconds) : Json(nullptr);
  json["peak_memory_mb"] = metrics.cost ? Json(metrics.cost->peak_memory_mb) : Json(nullptr);
  return json.dump(kIndent) + "\n";
}

SketchErrors read_run_errors(const std::filesystem::path& file) {
  const Json json = parse(file);
  SketchErrors errors;
  errors.share_within_1_m = number_at(json, "share_within_1_m", file);
  errors.share_within_2_m = number_at(json, "share_within_2_m", file);
  errors.scored =
      static_cast<std::size_t>(std::clamp(number_at(json, "scored_poses", file), 0.0, 1e15));
  errors.translation_m = median_at(json, "translation_error_m", file);
  errors.heading_rad = scaled(median_at(json, "heading_error_deg", file), rad_from_deg(1.0));
  if (!field(json, "first_loss_s", file).is_null()) {
    errors.first_loss_s = number_at(json, "first_loss_s", file);
  }
  const Json& lost = field(json, "lost_at_end", file);
  if (!lost.is_boolean()) {
    fail_to_read(file, "lost_at_end must be true or false, but it is " + lost.dump());
  }
  errors.lost_at_end = lost.get<bool>();
  return errors;
}

TrajectoryMetrics measure_trajectory(const MetricTrajectory& reference,
                                     const MetricTrajectory& estimate, double max_gap_s,
                                     const std::vector<RelativeErrorParams>& relative) {
  const MatchedPoses matched = match_poses(reference, estimate, max_gap_s);
  TrajectoryMetrics metrics{.poses = estimate.size(),
                            .matched = matched.world_from_robot.size(),
                            .unaligned = absolute_errors_aligned(matched, Alignment::None),
                            .first_pose = absolute_errors_aligned(matched, Alignment::FirstPose),
                            .se2 = absolute_errors_aligned(matched, Alignment::Se2),
                            .sim2 = absolute_errors_aligned(matched, Alignment::Sim2),
                            .relative = {}};
  for (const RelativeErrorParams& params : relative) {
    metrics.relative.push_back({params, relative_errors(matched, params)});
  }
  return metrics;
}

std::string to_json(const TrajectoryMetrics& metrics) {
  Json json;
  json["poses"] = metrics.poses;
  json["matched_poses"] = metrics.matched;
  json["ate_m"] = {{"unaligned", json_of(metrics.unaligned.translation_m)},
                   {"first_pose", json_of(metrics.first_pose.translation_m)},
                   {"se2", json_of(metrics.se2.translation_m)},
                   {"sim2", json_of(metrics.sim2.translation_m)}};
  json["rotation_error_deg"] = {{"unaligned", json_in_degrees(metrics.unaligned.rotation_rad)},
                                {"first_pose", json_in_degrees(metrics.first_pose.rotation_rad)},
                                {"se2", json_in_degrees(metrics.se2.rotation_rad)},
                                {"sim2", json_in_degrees(metrics.sim2.rotation_rad)}};
  json["rpe"] = Json::array();
  for (const RelativeErrors& relative : metrics.relative) {
    json["rpe"].push_back(json_of(relative));
  }
  return json.dump(kIndent) + "\n";
}

}  // namespace sketchloc
