#include "eval/keyframe_io.hpp"

#include <Eigen/Cholesky>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

namespace sketchloc {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Sim2& pose) { return {pose.x(), pose.y(), pose.yaw_rad(), pose.scale()}; }

Json json_of(const Eigen::Matrix4d& covariance) {
  Json rows = Json::array();
  for (Eigen::Index row = 0; row < 4; ++row) {
    rows.push_back(
        {covariance(row, 0), covariance(row, 1), covariance(row, 2), covariance(row, 3)});
  }
  return rows;
}

Json json_of(const Keyframe& keyframe) {
  const Se2& odom = keyframe.odom_from_robot;
  Json json{{"step", keyframe.step},
            {"time_s", keyframe.time_s},
            {"odom_from_robot", {odom.x_m(), odom.y_m(), odom.yaw_rad()}},
            {"way_m", keyframe.way_m},
            {"turn_rad", keyframe.turn_rad},
            {"hypotheses", Json::array()}};
  for (const PoseHypothesis& one : keyframe.hypotheses) {
    json["hypotheses"].push_back({{"sketch_from_robot", json_of(one.sketch_from_robot)},
                                  {"covariance", json_of(one.covariance)},
                                  {"inlier_probability", one.inlier_probability}});
  }
  return json;
}

Json json_of(const KeyframePair& pair) {
  const Se2& pose = pair.earlier_from_later;
  return {{"earlier", pair.earlier},
          {"later", pair.later},
          {"earlier_from_later", {pose.x_m(), pose.y_m(), pose.yaw_rad()}},
          {"probability", pair.probability}};
}

std::vector<double> numbers(const Json& json, std::size_t count) {
  std::vector<double> values = json.get<std::vector<double>>();
  if (values.size() != count) {
    throw std::runtime_error("expected " + std::to_string(count) + " numbers, found " +
                             std::to_string(values.size()));
  }
  return values;
}

Sim2 sim2_of(const Json& json) {
  const std::vector<double> pose = numbers(json, 4);
  if (!(pose[3] > 0.0)) {
    throw std::runtime_error("expected a scale above 0");
  }
  return Sim2::from_xy_yaw_scale(pose[0], pose[1], pose[2], pose[3]);
}

PoseHypothesis hypothesis_of(const Json& json) {
  PoseHypothesis one{.sketch_from_robot = sim2_of(json.at("sketch_from_robot")),
                     .inlier_probability = json.at("inlier_probability").get<double>()};
  const Json& rows = json.at("covariance");
  if (rows.size() != 4) {
    throw std::runtime_error("expected a covariance of 4 rows");
  }
  for (std::size_t row = 0; row < 4; ++row) {
    const std::vector<double> values = numbers(rows.at(row), 4);
    for (std::size_t column = 0; column < 4; ++column) {
      one.covariance(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) =
          values[column];
    }
  }
  if (!one.covariance.isApprox(one.covariance.transpose()) ||
      one.covariance.llt().info() != Eigen::Success) {
    throw std::runtime_error("expected a covariance: symmetric, no direction without variance");
  }
  if (!(one.inlier_probability >= 0.0 && one.inlier_probability <= 1.0)) {
    throw std::runtime_error("expected an inlier_probability from 0 to 1");
  }
  return one;
}

Keyframe keyframe_of(const Json& json) {
  const std::vector<double> odom = numbers(json.at("odom_from_robot"), 3);
  Keyframe keyframe{.step = json.at("step").get<std::size_t>(),
                    .time_s = json.at("time_s").get<double>(),
                    .odom_from_robot = Se2::from_xy_yaw(odom[0], odom[1], odom[2]),
                    .way_m = json.at("way_m").get<double>(),
                    .turn_rad = json.at("turn_rad").get<double>()};
  if (!(keyframe.way_m >= 0.0) || !(keyframe.turn_rad >= 0.0)) {
    throw std::runtime_error("expected a way_m and a turn_rad of at least 0");
  }
  for (const Json& one : json.at("hypotheses")) {
    keyframe.hypotheses.push_back(hypothesis_of(one));
  }
  return keyframe;
}

KeyframePair pair_of(const Json& json, const KeyframeRun& run) {
  const std::vector<double> pose = numbers(json.at("earlier_from_later"), 3);
  const KeyframePair pair{.earlier = json.at("earlier").get<std::size_t>(),
                          .later = json.at("later").get<std::size_t>(),
                          .earlier_from_later = Se2::from_xy_yaw(pose[0], pose[1], pose[2]),
                          .probability = json.at("probability").get<double>()};
  if (pair.earlier >= pair.later || pair.later >= run.keyframes.size()) {
    throw std::runtime_error("expected two keyframes of the lines before, the earlier one first");
  }
  if (!(pair.probability > 0.0 && pair.probability < 1.0)) {
    throw std::runtime_error("expected a probability between 0 and 1");
  }
  return pair;
}

void add_line(KeyframeRun& run, const std::string& line, bool is_first) {
  const Json json = Json::parse(line);
  if (is_first) {
    const Json& start = json.at("start_sketch_from_robot");
    run.start_sketch_from_robot = start.is_null() ? std::nullopt : std::optional(sim2_of(start));
    return;
  }
  if (json.contains("earlier_from_later")) {
    run.pairs.push_back(pair_of(json, run));
    return;
  }
  run.keyframes.push_back(keyframe_of(json));
  const std::size_t count = run.keyframes.size();
  if (count > 1 && run.keyframes[count - 2].step >= run.keyframes.back().step) {
    throw std::runtime_error("steps do not increase");
  }
}

}  // namespace

std::string to_jsonl(const KeyframeRun& run) {
  std::string text =
      Json{{"start_sketch_from_robot",
            run.start_sketch_from_robot ? json_of(*run.start_sketch_from_robot) : Json()}}
          .dump() +
      "\n";
  for (const Keyframe& keyframe : run.keyframes) {
    text += json_of(keyframe).dump() + "\n";
  }
  for (const KeyframePair& pair : run.pairs) {
    text += json_of(pair).dump() + "\n";
  }
  return text;
}

KeyframeRun read_keyframes(const std::filesystem::path& jsonl) {
  std::ifstream file(jsonl);
  if (!file) {
    throw std::runtime_error(jsonl.string() +
                             ": cannot be read; make it with sketchloc localize --smooth");
  }
  KeyframeRun run;
  std::size_t number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    try {
      add_line(run, line, number == 1);
    } catch (const std::exception& error) {
      throw std::runtime_error(jsonl.string() + ":" + std::to_string(number) + ": " + error.what() +
                               "; make it anew with sketchloc localize --smooth");
    }
  }
  if (run.keyframes.empty()) {
    throw std::runtime_error(jsonl.string() +
                             ": has no keyframes; make it anew with sketchloc localize --smooth");
  }
  return run;
}

}  // namespace sketchloc
