#include "apps/given_drawing.hpp"

#include <stdexcept>
#include <string>
#include <vector>

#include "apps/config.hpp"
#include "datasets/io/correspondence_io.hpp"

namespace sketchloc {
namespace {

template <typename T>
PictureSize size_of(const Grid<T>& grid) {
  return {.width_px = grid.width(), .height_px = grid.height()};
}

/// The smallest box around the map's free cells.
PlaneBox layout_in_world(const MetricMap& map) {
  Eigen::Vector2d low(map.cells.width(), map.cells.height());
  Eigen::Vector2d high = Eigen::Vector2d::Zero();
  for (int row = 0; row < map.cells.height(); ++row) {
    for (int column = 0; column < map.cells.width(); ++column) {
      if (map.cells.at({column, row}) == MetricMap::Free) {
        low = low.cwiseMin(Eigen::Vector2d(column, row));
        high = high.cwiseMax(Eigen::Vector2d(column + 1, row + 1));
      }
    }
  }
  return {map.world_from_cells(low), map.world_from_cells(high)};
}

std::string kind_name(CorrespondenceFit::Kind kind) {
  switch (kind) {
    case CorrespondenceFit::Kind::Similarity:
      return "similarity";
    case CorrespondenceFit::Kind::Affine:
      return "affine";
    case CorrespondenceFit::Kind::ThinPlateSpline:
      return "spline";
  }
  return "";
}

double share_of(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

GivenDrawing read_given_drawing(const std::filesystem::path& drawing, const SketchReading& reading,
                                std::span<const std::filesystem::path> correspondences,
                                const MetricMap& map) {
  GivenDrawing given{.drawing = {.sketch = read_any_drawing(drawing, reading)}, .fit = {}};
  std::vector<PlacePair> places;
  for (const std::filesystem::path& csv : correspondences) {
    for (const Correspondence& pair :
         read_correspondences(csv, size_of(given.drawing.sketch.occupied), size_of(map.cells))) {
      places.push_back({.point_in_world = map.world_from_cells(pair.point_in_model),
                        .point_in_sketch = pair.point_in_sketch});
    }
  }
  given.fit = fit_correspondences(places, layout_in_world(map));
  if (given.fit.status == CorrespondenceFit::Status::TooFewPlaces) {
    throw std::runtime_error(drawing.string() + ": " + std::to_string(places.size()) +
                             " places in --correspondences are too few or too close together; "
                             "give at least three");
  }
  if (given.fit.status == CorrespondenceFit::Status::Folded) {
    throw std::runtime_error(drawing.string() +
                             ": the places in --correspondences mirror or fold the map; check "
                             "that they belong to this drawing");
  }
  given.drawing.sketch_from_world = given.fit.sketch_from_world;
  return given;
}

ConfigNode support_of(const DataSet& data_set, const CorrespondenceFit& fit) {
  const Grid<std::uint8_t>& occupied = data_set.drawing.sketch.occupied;
  std::size_t scored = 0;
  std::size_t free = 0;
  for (const ReferencePose& pose : data_set.reference.poses) {
    if (pose.scored) {
      ++scored;
      free += occupied.at(cell_at(pose.sketch_from_robot.translation())) == 0 ? 1U : 0U;
    }
  }
  ConfigNode support;
  support.child("map").text = kind_name(fit.kind);
  support.child("smoothing_m2") = to_config(fit.smoothing_m2);
  support.child("residual_px") = to_config(fit.residual_px);
  support.child("left_out_px") = to_config(fit.left_out_px);
  support.child("left_out_m") = to_config(fit.left_out_m);
  support.child("scored_share") = to_config(share_of(scored, data_set.reference.poses.size()));
  support.child("scored_in_free_space_share") = to_config(share_of(free, scored));
  return support;
}

}  // namespace sketchloc
