#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "eval/detail/canvas.hpp"
#include "eval/detail/run_picture.hpp"
#include "eval/graph_record.hpp"

namespace sketchloc {
namespace {

using detail::Frame;
using detail::PathLayer;
using detail::View;

constexpr int kPanel_px = 800;
constexpr int kCaption_px = 40;
constexpr double kMargin = 0.04;  ///< of the picture's side

Eigen::Vector2d place(const PoseGraph& graph, std::size_t vertex) {
  const GraphPose& pose = graph.vertices[vertex].frame_from_body;
  return {pose.x, pose.y};
}

/// A square with all poses.
View square_view(const PoseGraph& graph) {
  Eigen::Vector2d low = place(graph, 0);
  Eigen::Vector2d high = low;
  for (std::size_t i = 0; i < graph.vertices.size(); ++i) {
    low = low.cwiseMin(place(graph, i));
    high = high.cwiseMax(place(graph, i));
  }
  const Eigen::Vector2d centre = 0.5 * (low + high);
  const double half = std::max(0.5 * (high - low).maxCoeff(), 1e-3) * (1.0 + 2.0 * kMargin);
  return {.low = centre.array() - half, .high = centre.array() + half};
}

/// Loop closures under the way; those taken for wrong in another colour.
std::vector<PathLayer> layers_of(const PoseGraph& graph, const std::vector<double>& weights) {
  PathLayer way{.name = "steps", .colour = detail::kReferenceBlue, .width = 1.2};
  PathLayer kept{.name = "loop closures", .colour = detail::kGood, .width = 0.5};
  PathLayer rejected{.name = "taken for wrong", .colour = detail::kBad, .width = 0.5};
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const GraphEdge& edge = graph.edges[i];
    PathLayer& layer = weights[i] < 0.5 ? rejected : edge.may_be_wrong ? kept : way;
    layer.lines.push_back({place(graph, edge.first), place(graph, edge.second)});
  }
  return {rejected, kept, way};
}

cv::Mat3b panel(const PoseGraph& graph, const std::vector<double>& weights,
                const std::string& caption) {
  cv::Mat3b image(kPanel_px, kPanel_px, cv::Vec3b(255, 255, 255));
  Frame frame{.view = square_view(graph)};
  frame.zoom = kPanel_px / frame.view.width();
  for (const PathLayer& layer : layers_of(graph, weights)) {
    draw_layer(image, layer, frame, 1.6);
  }
  cv::Mat3b below(kCaption_px, kPanel_px, cv::Vec3b(255, 255, 255));
  detail::write_text(below, caption, {14, kCaption_px - 14}, 0.65);
  image.push_back(below);
  return image;
}

}  // namespace

std::string picture_png(const GraphRecord& record) {
  if (record.before.vertices.empty()) {
    return detail::png_bytes(cv::Mat3b(1, 1, cv::Vec3b(255, 255, 255)));
  }
  const std::vector<double> none(record.before.edges.size(), 1.0);
  const auto rounded = [](double chi2) { return cv::format("%.6g", chi2); };
  cv::Mat3b both;
  cv::hconcat(panel(record.before, none, "before: chi2 " + rounded(record.start_chi2)),
              panel(record.after, record.result.weights,
                    "after: chi2 " + rounded(record.result.chi2) +
                        ", taken for wrong: " + std::to_string(rejected_edges(record))),
              both);
  return detail::png_bytes(both);
}

}  // namespace sketchloc
