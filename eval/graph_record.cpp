#include "eval/graph_record.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "motion/trajectory.hpp"

namespace sketchloc {

std::string name_of(OptimiseResult::Status status) {
  switch (status) {
    case OptimiseResult::Status::Converged:
      return "converged";
    case OptimiseResult::Status::IterationLimit:
      return "iteration limit";
    case OptimiseResult::Status::Singular:
      return "singular";
  }
  return "unknown";
}

std::size_t doubted_edges(const GraphRecord& record) {
  return static_cast<std::size_t>(
      std::ranges::count(record.before.edges, true, &GraphEdge::may_be_wrong));
}

std::size_t rejected_edges(const GraphRecord& record) {
  return static_cast<std::size_t>(
      std::ranges::count_if(record.result.weights, [](double weight) { return weight < 0.5; }));
}

std::optional<double> position_rmse_m(const PoseGraph& estimate, const PoseGraph& reference) {
  std::map<std::int64_t, Eigen::Vector2d> places;
  for (const GraphVertex& vertex : reference.vertices) {
    places[vertex.id] = {vertex.frame_from_body.x, vertex.frame_from_body.y};
  }
  std::vector<Eigen::Vector2d> from;
  std::vector<Eigen::Vector2d> to;
  for (const GraphVertex& vertex : estimate.vertices) {
    if (const auto found = places.find(vertex.id); found != places.end()) {
      from.emplace_back(vertex.frame_from_body.x, vertex.frame_from_body.y);
      to.push_back(found->second);
    }
  }
  if (from.size() < 2) {
    return std::nullopt;
  }
  const Se2 reference_from_estimate = align_se2(from, to);
  double sum = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    sum += (reference_from_estimate * from[i] - to[i]).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(from.size()));
}

std::string to_json(const GraphRecord& record) {
  const auto names = names_of(KernelShape{});
  const auto kernel = std::ranges::find(names, record.params.kernel.shape,
                                        &std::pair<std::string_view, KernelShape>::second);
  nlohmann::ordered_json json = {{"chi2", record.result.chi2},
                                 {"cost", record.result.cost},
                                 {"start_chi2", record.start_chi2},
                                 {"status", name_of(record.result.status)},
                                 {"iterations", record.result.iterations},
                                 {"seconds", record.seconds},
                                 {"kernel", kernel->first},
                                 {"vertices", record.before.vertices.size()},
                                 {"edges", record.before.edges.size()},
                                 {"doubted_edges", doubted_edges(record)},
                                 {"rejected_edges", rejected_edges(record)}};
  if (record.growing) {
    json["updates"] = record.growing->updates;
    json["batches"] = record.growing->batches;
    json["mean_update_ms"] = 1e3 * record.growing->mean_update_s;
    json["worst_update_ms"] = 1e3 * record.growing->worst_update_s;
    json["chi2_before_finish"] = record.growing->chi2_before_finish;
  }
  if (record.rmse_m) {
    json["rmse_m"] = *record.rmse_m;
  }
  return json.dump(2) + "\n";
}

}  // namespace sketchloc
