#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "eval/detail/canvas.hpp"
#include "eval/detail/run_picture.hpp"
#include "eval/topology_record.hpp"

namespace sketchloc {
namespace {

using detail::Colour;
using detail::Frame;
using detail::PathLayer;
using detail::View;

constexpr int kPanel_px = 760;
constexpr int kCaption_px = 40;
constexpr double kMargin = 0.04;  ///< of the picture's side
constexpr double kLine = 1.6;

const std::array<Colour, 3> kLabelColours = {detail::kReferenceBlue, detail::kGood, detail::kBad};

const Colour& colour_of(PlaceLabel label) { return kLabelColours[static_cast<std::size_t>(label)]; }

View square_view(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d low = points.front();
  Eigen::Vector2d high = low;
  for (const Eigen::Vector2d& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const Eigen::Vector2d centre = 0.5 * (low + high);
  const double half = std::max(0.5 * (high - low).maxCoeff(), 1.0) * (1.0 + 2.0 * kMargin);
  return {.low = centre.array() - half, .high = centre.array() + half};
}

/// The way pose by pose, one layer for each label.
std::vector<PathLayer> labelled_way(const std::vector<Eigen::Vector2d>& points,
                                    const std::vector<PlaceLabel>& labels) {
  std::vector<PathLayer> layers;
  for (const auto& [name, label] : names_of(PlaceLabel{})) {
    layers.push_back({.name = std::string(name), .colour = colour_of(label), .width = 1.0});
  }
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    layers[static_cast<std::size_t>(labels[i])].lines.push_back({points[i], points[i + 1]});
  }
  return layers;
}

/// Nodes as thick straight lines, what joins them thin, pairs of the same place dashed.
std::vector<PathLayer> graph_layers(const RecoveredRun& run,
                                    const std::vector<Eigen::Vector2d>& points) {
  PathLayer joins{.name = "", .colour = detail::kGrey, .width = 0.5};
  PathLayer pairs{.name = "same place", .colour = detail::kFair, .width = 0.7};
  std::vector<PathLayer> layers;
  for (const auto& [name, label] : names_of(PlaceLabel{})) {
    layers.push_back({.name = std::string(name), .colour = colour_of(label), .width = 2.2});
  }
  const auto& nodes = run.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    layers[static_cast<std::size_t>(nodes[i].label)].lines.push_back(
        {points[nodes[i].first], points[nodes[i].last]});
    if (i + 1 < nodes.size()) {
      joins.lines.push_back({points[nodes[i].last], points[nodes[i + 1].first]});
    }
  }
  const auto middle = [&](std::size_t node) {
    return Eigen::Vector2d(0.5 * (points[nodes[node].first] + points[nodes[node].last]));
  };
  for (const SamePlacePair& pair : run.pairs) {
    pairs.lines.push_back({middle(pair.earlier), middle(pair.later)});
  }
  layers.insert(layers.begin(), joins);
  layers.push_back(pairs);
  return layers;
}

void write_legend(cv::Mat3b& image) {
  int y_px = 26;
  for (const auto& [name, label] : names_of(PlaceLabel{})) {
    detail::draw_line(image, {{14.0, y_px - 5.0}, {40.0, y_px - 5.0}},
                      {.name = "", .colour = colour_of(label)}, 2.0);
    detail::write_text(image, std::string(name), {48, y_px}, 0.5);
    y_px += 22;
  }
}

cv::Mat3b panel(const std::vector<PathLayer>& layers, const View& view,
                const std::string& caption) {
  cv::Mat3b image(kPanel_px, kPanel_px, cv::Vec3b(255, 255, 255));
  const Frame frame{.view = view, .zoom = kPanel_px / view.width()};
  for (const PathLayer& layer : layers) {
    draw_layer(image, layer, frame, kLine);
  }
  write_legend(image);
  cv::Mat3b below(kCaption_px, kPanel_px, cv::Vec3b(255, 255, 255));
  detail::write_text(below, caption, {14, kCaption_px - 14}, 0.6);
  image.push_back(below);
  return image;
}

std::vector<Eigen::Vector2d> points_of(const MetricTrajectory& trajectory) {
  std::vector<Eigen::Vector2d> points;
  for (const Stamped<Se2>& stamped : trajectory) {
    points.push_back(stamped.pose.translation());
  }
  return points;
}

PathLayer reference_layer(const TopologyRecord& record) {
  PathLayer layer{.name = "reference", .colour = detail::kGrey, .width = 2.4};
  if (!record.reference) {
    return layer;
  }
  const std::vector<Eigen::Vector2d> from = points_of(*record.reference);
  const std::vector<Eigen::Vector2d> to = points_of(record.recovered);
  const Se2 recovered_from_reference = align_se2(from, to);
  detail::Polyline line;
  for (const Eigen::Vector2d& point : from) {
    line.push_back(recovered_from_reference * point);
  }
  layer.lines = {line};
  return layer;
}

}  // namespace

std::string picture_png(const TopologyRecord& record) {
  if (record.odometry.empty()) {
    return detail::png_bytes(cv::Mat3b(1, 1, cv::Vec3b(255, 255, 255)));
  }
  const std::vector<Eigen::Vector2d> before = points_of(record.odometry);
  const std::vector<Eigen::Vector2d> after = points_of(record.recovered);
  std::vector<PathLayer> recovered = labelled_way(after, record.labels);
  recovered.insert(recovered.begin(), reference_layer(record));
  const std::string pairs = std::to_string(record.run.pairs.size());
  std::vector<cv::Mat3b> panels = {
      panel(labelled_way(before, record.labels), square_view(before), "odometry"),
      panel(graph_layers(record.run, after), square_view(after),
            "nodes, and " + pairs + " pairs taken for one place"),
      panel(recovered, square_view(after),
            record.reference ? "recovered; grey: reference, laid onto it" : "recovered")};
  cv::Mat3b whole;
  cv::hconcat(panels, whole);
  return detail::png_bytes(whole);
}

}  // namespace sketchloc
