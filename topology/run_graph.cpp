#include "topology/run_graph.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/angles.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

/// Holds the first position: much surer than any edge.
constexpr double kHeld_m = 1e-4;
constexpr double kHeld_rad = 1e-5;

double squared(double value) { return value * value; }

Eigen::Matrix3d step_information(double way_m, double turn_rad, const DriftParams& drift,
                                 const RunGraphParams& params) {
  const double position = squared(params.step_sigma_m) * way_m + squared(params.least_sigma_m);
  const double quarters = std::abs(turn_rad) / (0.5 * std::numbers::pi);
  const double heading = squared(rad_from_deg(drift.wander_deg)) * way_m +
                         squared(rad_from_deg(drift.turn_error_deg)) * quarters +
                         squared(rad_from_deg(params.least_sigma_deg));
  return Eigen::Vector3d(1.0 / position, 1.0 / position, 1.0 / heading).asDiagonal();
}

/// Where poses `at` are: the headings without drift, decided up to whole turns.
std::vector<double> true_headings(const HeadingEvidence& evidence) {
  std::vector<double> yaw_rad = evidence.travel.yaw_rad;
  for (std::size_t i = 0; i < yaw_rad.size(); ++i) {
    yaw_rad[i] -= evidence.drift_rad[i];
  }
  return yaw_rad;
}

void add_steps(PoseGraph& graph, const HeadingEvidence& evidence, const RunGraphParams& params) {
  const Travel& travel = evidence.travel;
  for (std::size_t i = 0; i + 1 < graph.vertices.size(); ++i) {
    graph.edges.push_back(
        {.kind = EdgeKind::Between,
         .first = i,
         .second = i + 1,
         .measured =
             between(graph.vertices[i].frame_from_body, graph.vertices[i + 1].frame_from_body),
         .information = information_of(step_information(travel.way_m[i + 1] - travel.way_m[i],
                                                        travel.yaw_rad[i + 1] - travel.yaw_rad[i],
                                                        evidence.drift, params))});
  }
}

/// The heading of a pose is that of its piece and what it differed from it in the odometry.
void add_axes(PoseGraph& graph, const HeadingEvidence& evidence) {
  const DriftParams& drift = evidence.drift;
  for (std::size_t i = 0; i < evidence.pieces.size(); ++i) {
    const StraightPiece& piece = evidence.pieces[i];
    const PieceHeading& heading = evidence.headings[i];
    const std::size_t middle = (piece.first + piece.last) / 2;
    const double yaw_rad =
        angle_rad(heading.quarter_turns) + evidence.travel.yaw_rad[middle] - piece.axis_rad;
    const double information =
        heading.on_axis / squared(rad_from_deg(drift.axis_sigma_deg)) +
        (1.0 - heading.on_axis) / squared(rad_from_deg(drift.skew_sigma_deg));
    Eigen::Matrix3d of_heading = Eigen::Matrix3d::Zero();
    of_heading(2, 2) = information;
    graph.edges.push_back({.kind = EdgeKind::Prior,
                           .first = middle,
                           .second = middle,
                           .measured = {.yaw_rad = yaw_rad},
                           .information = information_of(of_heading)});
  }
}

void hold_first(PoseGraph& graph, bool also_heading) {
  const Eigen::Vector3d sigma(kHeld_m, kHeld_m, kHeld_rad);
  Eigen::Matrix3d information = sigma.cwiseProduct(sigma).cwiseInverse().asDiagonal();
  if (!also_heading) {
    information(2, 2) = 0.0;
  }
  graph.edges.push_back({.kind = EdgeKind::Prior,
                         .first = 0,
                         .second = 0,
                         .measured = graph.vertices[0].frame_from_body,
                         .information = information_of(information)});
}

}  // namespace

void validate(const RunGraphParams& params) {
  require_above("step_sigma_m", params.step_sigma_m, 0.0);
  require_above("least_sigma_m", params.least_sigma_m, 0.0);
  require_above("least_sigma_deg", params.least_sigma_deg, 0.0);
  require_above("pass_sigma_m", params.pass_sigma_m, 0.0);
}

PoseGraph run_graph(std::span<const Se2> odom_from_robot, const HeadingEvidence& evidence,
                    const RunGraphParams& params) {
  validate(params);
  PoseGraph graph;
  const std::vector<double> yaw_rad = true_headings(evidence);
  const std::vector<Se2> poses = with_headings(odom_from_robot, yaw_rad);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    graph.vertices.push_back(
        {.id = static_cast<std::int64_t>(i),
         .frame_from_body = {.x = poses[i].x_m(), .y = poses[i].y_m(), .yaw_rad = yaw_rad[i]}});
  }
  if (graph.vertices.empty()) {
    return graph;
  }
  add_steps(graph, evidence, params);
  add_axes(graph, evidence);
  hold_first(graph, evidence.pieces.empty());
  return graph;
}

void tie_together(PoseGraph& graph, const SamePlacePair& pair, const RunGraphParams& params) {
  const PosesBeside beside = typical(pair);
  Eigen::Matrix3d across = Eigen::Matrix3d::Zero();
  across(1, 1) = 1.0 / squared(params.pass_sigma_m);
  graph.edges.push_back(between_edge(beside.earlier, beside.later, Se2(), across));
  graph.edges.back().may_be_wrong = true;
}

}  // namespace sketchloc
