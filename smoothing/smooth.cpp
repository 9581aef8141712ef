#include "smoothing/smooth.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "motion/angles.hpp"
#include "motion/check.hpp"
#include "motion/graph/covariance.hpp"

namespace sketchloc {
namespace {

constexpr double kSamePlaceM = 2.0;  ///< what counts as the same place, see SmoothedPose
constexpr double kSamePlaceRad = std::numbers::pi / 6.0;

Se2 odometry_between(const Keyframe& before, const Keyframe& now) {
  return before.odom_from_robot.inverse() * now.odom_from_robot;
}

/// The poses of the branch; where a keyframe has none, carried on by odometry.
std::vector<Sim2> branch_poses(const KeyframeRun& run, const Branch& branch) {
  const std::vector<Keyframe>& keyframes = run.keyframes;
  std::vector<Sim2> poses(keyframes.size());
  const auto known = std::ranges::find_if(
      branch.chosen, [](const std::optional<std::size_t>& one) { return one.has_value(); });
  const auto first = static_cast<std::size_t>(known - branch.chosen.begin());
  for (std::size_t k = first; k < keyframes.size(); ++k) {
    poses[k] = branch.chosen[k] ? keyframes[k].hypotheses[*branch.chosen[k]].sketch_from_robot
                                : poses[k - 1] * odometry_between(keyframes[k - 1], keyframes[k]);
  }
  for (std::size_t k = first; k-- > 0;) {
    poses[k] = poses[k + 1] * odometry_between(keyframes[k + 1], keyframes[k]);
  }
  return poses;
}

Eigen::Matrix4d symmetric_inverse(const Eigen::Matrix4d& covariance) {
  const Eigen::Matrix4d inverse = covariance.inverse();
  return 0.5 * (inverse + inverse.transpose());
}

/// The covariance of a registration, with what no registration tells.
Eigen::Matrix4d widened(const Eigen::Matrix4d& covariance, const SmoothingParams& params) {
  const Eigen::Vector4d least(params.min_position_m, params.min_position_m, params.min_heading_rad,
                              params.min_log_scale);
  Eigen::Matrix4d wide = covariance;
  wide.diagonal() += least.cwiseAbs2();
  return wide;
}

void add_odometry(PoseGraph& graph, const KeyframeRun& run, const SmoothingParams& params) {
  for (std::size_t k = 1; k < run.keyframes.size(); ++k) {
    const Keyframe& now = run.keyframes[k];
    const Eigen::Matrix4d information =
        symmetric_inverse(walk_covariance(params.walk, now.way_m, now.turn_rad));
    GraphEdge edge = between_edge(
        k - 1, k, Sim2::from_se2(odometry_between(run.keyframes[k - 1], now)), information);
    const Sim2 off =
        to_sim2(edge.measured).inverse() *
        to_sim2(between(graph.vertices[k - 1].frame_from_body, graph.vertices[k].frame_from_body));
    const Eigen::Vector4d error(off.x(), off.y(), off.yaw_rad(), std::log(off.scale()));
    edge.may_be_wrong = error.dot(information * error) > -2.0 * params.jump_log_odds;
    graph.edges.push_back(edge);
  }
}

void add_registrations(PoseGraph& graph, const KeyframeRun& run, const SmoothingParams& params) {
  for (std::size_t k = 0; k < run.keyframes.size(); ++k) {
    for (const PoseHypothesis& one : run.keyframes[k].hypotheses) {
      const double counts = params.independent_share * one.inlier_probability;
      GraphEdge edge = prior_edge(k, one.sketch_from_robot,
                                  counts * symmetric_inverse(widened(one.covariance, params)));
      edge.may_be_wrong = true;
      graph.edges.push_back(edge);
    }
  }
}

/// Pairs behind the kernel: the drawing is one and the same at both passes.
void add_pairs(PoseGraph& graph, const KeyframeRun& run, const SmoothingParams& params) {
  for (const KeyframePair& pair : run.pairs) {
    GraphEdge edge = between_edge(
        pair.earlier, pair.later, Sim2::from_se2(pair.earlier_from_later),
        params.independent_share * pair.probability * symmetric_inverse(pair_covariance(params)));
    edge.may_be_wrong = true;
    graph.edges.push_back(edge);
  }
}

/// The probability of the hypotheses of a keyframe that are where the pose is.
double probability_of(const Sim2& sketch_from_robot, const Keyframe& keyframe,
                      const std::vector<double>& probability) {
  double sum = 0.0;
  for (std::size_t i = 0; i < probability.size(); ++i) {
    const Sim2 off = sketch_from_robot.inverse() * keyframe.hypotheses[i].sketch_from_robot;
    sum += off.translation().norm() <= kSamePlaceM && std::abs(off.yaw_rad()) <= kSamePlaceRad
               ? probability[i]
               : 0.0;
  }
  return std::min(1.0, sum);
}

/// Keyframes without hypotheses take the probability of the nearest one with some.
void state_probabilities(const KeyframeRun& run, const Branch& branch, SmoothedRun& result) {
  std::vector<std::size_t> stated;
  for (std::size_t k = 0; k < run.keyframes.size(); ++k) {
    if (branch.chosen[k]) {
      result.poses[k].probability = probability_of(result.poses[k].sketch_from_robot,
                                                   run.keyframes[k], branch.probability[k]);
      stated.push_back(k);
    }
  }
  for (std::size_t k = 0; k < run.keyframes.size(); ++k) {
    const auto away = [k](std::size_t other) { return other > k ? other - k : k - other; };
    result.poses[k].probability =
        result.poses[*std::ranges::min_element(stated, {}, away)].probability;
  }
}

}  // namespace

PoseGraph branch_graph(const KeyframeRun& run, const Branch& branch,
                       const SmoothingParams& params) {
  PoseGraph graph;
  for (const Sim2& pose : branch_poses(run, branch)) {
    graph.vertices.push_back({.id = static_cast<std::int64_t>(graph.vertices.size()),
                              .kind = VertexKind::Sim2,
                              .frame_from_body = graph_pose(pose)});
  }
  if (run.start_sketch_from_robot) {
    graph.edges.push_back(
        prior_edge(0, *run.start_sketch_from_robot, symmetric_inverse(start_covariance(params))));
  }
  add_odometry(graph, run, params);
  add_registrations(graph, run, params);
  add_pairs(graph, run, params);
  return graph;
}

SmoothedRun smooth(const KeyframeRun& run, const SmoothingParams& params) {
  validate(params);
  SmoothedRun result;
  if (std::ranges::all_of(run.keyframes,
                          [](const Keyframe& one) { return one.hypotheses.empty(); })) {
    return result;
  }
  const Branch branch = find_branch(run, params);
  PoseGraph graph = branch_graph(run, branch, params);
  const OptimiseResult best =
      optimise(graph, {.kernel = params.kernel, .initial = GraphStart::Given});
  graph = with_poses(graph, best.poses);
  std::vector<std::size_t> all(graph.vertices.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const auto spread = covariances(graph, all, best.weights);
  for (std::size_t k = 0; k < all.size(); ++k) {
    result.poses.push_back({.sketch_from_robot = to_sim2(graph.vertices[k].frame_from_body)});
    if (spread) {
      result.poses.back().covariance = (*spread)[k];
    }
  }
  state_probabilities(run, branch, result);
  result.status = SmoothedRun::Status::Done;
  return result;
}

Sim2 carried_pose(const KeyframeRun& run, std::span<const SmoothedPose> smoothed, std::size_t step,
                  const Se2& odom_from_robot) {
  check(!smoothed.empty() && smoothed.size() == run.keyframes.size(), "a pose per keyframe");
  const auto carried = [&](std::size_t k) {
    return smoothed[k].sketch_from_robot *
           (run.keyframes[k].odom_from_robot.inverse() * odom_from_robot);
  };
  const auto after = std::ranges::upper_bound(run.keyframes, step, {}, &Keyframe::step);
  const auto next = static_cast<std::size_t>(after - run.keyframes.begin());
  if (next == 0) {
    return carried(0);
  }
  const std::size_t last = next - 1;
  const std::size_t since = step - run.keyframes[last].step;
  if (next == run.keyframes.size() || since == 0) {
    return carried(last);
  }
  const double share = static_cast<double>(since) /
                       static_cast<double>(run.keyframes[next].step - run.keyframes[last].step);
  return interpolate(carried(last), carried(next), share);
}

std::vector<Sim2> carried_poses(const KeyframeRun& run, std::span<const SmoothedPose> smoothed,
                                std::span<const Se2> odom_from_robot) {
  std::vector<Sim2> poses;
  for (std::size_t step = 0; step < odom_from_robot.size(); ++step) {
    poses.push_back(carried_pose(run, smoothed, step, odom_from_robot[step]));
  }
  return poses;
}

}  // namespace sketchloc
