#include "eval/topology_record.hpp"

#include <iterator>
#include <nlohmann/json.hpp>

#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const ErrorSummary& summary) {
  return {{"mean", summary.mean},
          {"median", summary.median},
          {"rmse", summary.rmse},
          {"p90", summary.p90},
          {"max", summary.max}};
}

Json ate(const MetricErrors& errors) {
  return {{"unaligned", to_json(errors.unaligned)},
          {"first_pose", to_json(errors.first_pose)},
          {"se2", to_json(errors.se2)}};
}

std::string csv_line(std::initializer_list<double> values) {
  std::string line;
  for (const double value : values) {
    line += line.empty() ? "" : ",";
    append_number(line, value);
  }
  return line;
}

Json to_json(const ConfusionMatrix& confusion) {
  Json recall;
  Json precision;
  for (const auto& [name, label] : names_of(PlaceLabel{})) {
    recall[name] = confusion.recall(static_cast<std::size_t>(label));
    precision[name] = confusion.precision(static_cast<std::size_t>(label));
  }
  return {{"accuracy", confusion.accuracy()},
          {"recall", recall},
          {"precision", precision},
          {"used_of_true", confusion.given_of_right}};
}

}  // namespace

ConfusionMatrix label_confusion(const TopologyRecord& record) {
  ConfusionMatrix confusion(names_of(PlaceLabel{}).size());
  for (std::size_t i = 0; i < record.labels.size(); ++i) {
    confusion.add(static_cast<std::size_t>(record.reference_labels->at(i)),
                  static_cast<std::size_t>(record.labels[i]));
  }
  return confusion;
}

std::string to_json(const TopologyRecord& record) {
  const RecoveredRun& run = record.run;
  Json json = {
      {"poses", record.odometry.size()},
      {"way_m", run.evidence.travel.way_m.empty() ? 0.0 : run.evidence.travel.way_m.back()},
      {"straight_pieces", run.evidence.pieces.size()},
      {"nodes", run.nodes.size()},
      {"same_place_pairs", run.pairs.size()},
      {"closed_by_scans", run.closures},
      {"rounds", run.rounds},
      {"chi2", run.result.chi2},
      {"seconds", record.seconds}};
  if (record.growing) {
    json["updates"] = record.growing->updates;
    json["worst_update_ms"] = 1e3 * record.growing->worst_update_s;
  }
  if (record.reference) {
    json["ate_m"] = ate(metric_errors(*record.reference, record.recovered));
    json["odometry_ate_m"] = ate(metric_errors(*record.reference, record.odometry));
    if (record.growing) {
      json["online_ate_m"] = ate(metric_errors(*record.reference, record.growing->online));
    }
    const PairCounts pairs = count_pairs(run, poses_of(*record.reference));
    json["same_place"] = {{"used", pairs.used}, {"right", pairs.right}, {"all", pairs.all}};
  }
  if (record.reference_labels) {
    json["labels"] = to_json(label_confusion(record));
  }
  return json.dump(2) + "\n";
}

std::string nodes_csv(const TopologyRecord& record) {
  std::string text =
      "node,label_name,first_pose,last_pose,length_m,quarter_turns,x1_m,y1_m,x2_m,y2_m\n";
  const auto& poses = record.run.manhattan_from_robot;
  for (std::size_t i = 0; i < record.run.nodes.size(); ++i) {
    const TopologicalNode& node = record.run.nodes[i];
    const Eigen::Vector2d begin = poses[node.first].translation();
    const Eigen::Vector2d end = poses[node.last].translation();
    const int quarter_turns =
        nearest_quarter_turns(std::atan2(end.y() - begin.y(), end.x() - begin.x()));
    text += std::to_string(i) + "," + std::string(name_of(node.label)) + "," +
            std::to_string(node.first) + "," + std::to_string(node.last) + "," +
            csv_line({node.length_m}) + "," + std::to_string(quarter_turns) + "," +
            csv_line({begin.x(), begin.y(), end.x(), end.y()}) + "\n";
  }
  return text;
}

std::string pairs_csv(const TopologyRecord& record) {
  std::string text = "earlier_node,later_node,probability,across_m\n";
  for (const SamePlacePair& pair : record.run.pairs) {
    text += std::to_string(pair.earlier) + "," + std::to_string(pair.later) + "," +
            csv_line({pair.probability, pair.across_m}) + "\n";
  }
  return text;
}

}  // namespace sketchloc
