#include "datasets/sim/person.hpp"

#include <cmath>

#include "datasets/sim/detail/distortion.hpp"
#include "datasets/sim/detail/pen.hpp"
#include "datasets/sim/raster.hpp"
#include "motion/check.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

using detail::Stroke;

constexpr double kSpacing_m = 0.1;  ///< of the points at which a line is distorted

Stroke distorted(const Stroke& stroke_in_world, const Deformation& sketch_from_world) {
  Stroke stroke_in_sketch;
  for (const Eigen::Vector2d& point : detail::resample(stroke_in_world, kSpacing_m)) {
    stroke_in_sketch.push_back(sketch_from_world(point));
  }
  return stroke_in_sketch;
}

PlaneBox bounds(const std::vector<Stroke>& strokes) {
  check(!strokes.empty(), "a drawing has strokes");
  PlaneBox box = {strokes[0][0], strokes[0][0]};
  for (const Stroke& stroke : strokes) {
    for (const Eigen::Vector2d& point : stroke) {
      box.low = box.low.cwiseMin(point);
      box.high = box.high.cwiseMax(point);
    }
  }
  return box;
}

/// The box with paper left free on each side.
PlaneBox with_margins(const PlaneBox& box, const PenParams& pen, Rng& rng) {
  const double least_px = 5.0 + pen.max_stroke_px;
  PlaneBox paper = box;
  for (int axis = 0; axis < 2; ++axis) {
    paper.low(axis) -= least_px + uniform(0.0, pen.max_margin_px, rng);
    paper.high(axis) += least_px + uniform(0.0, pen.max_margin_px, rng);
  }
  return paper;
}

Grid<std::uint8_t> ink(const std::vector<Stroke>& strokes, const PlaneBox& paper,
                       double stroke_width_px) {
  const Eigen::Vector2d size = paper.size();
  Grid<std::uint8_t> occupied(static_cast<int>(std::ceil(size.x())),
                              static_cast<int>(std::ceil(size.y())));
  for (const Stroke& stroke : strokes) {
    Stroke on_paper = stroke;
    for (Eigen::Vector2d& point : on_paper) {
      point -= paper.low;
    }
    paint_polyline(occupied, on_paper, stroke_width_px);
  }
  return occupied;
}

}  // namespace

void validate(const DistortionParams& distortion) {
  require_above("px_per_m", distortion.px_per_m, 0.0);
  require_in_range("px_per_m_log_sigma", distortion.px_per_m_log_sigma, 0.0, 2.0);
  require_at_least("tilt_sigma_rad", distortion.tilt_sigma_rad, 0.0);
  require_in_range("turned_share", distortion.turned_share, 0.0, 1.0);
  require_in_range("proportion_log_sigma", distortion.proportion_log_sigma, 0.0, 2.0);
  require_in_range("room_log_sigma", distortion.room_log_sigma, 0.0, 2.0);
  require_in_range("corridor_log_mean", distortion.corridor_log_mean, -2.0, 2.0);
  require_in_range("corridor_log_sigma", distortion.corridor_log_sigma, 0.0, 2.0);
  require_at_least("room_shear_sigma", distortion.room_shear_sigma, 0.0);
  require_above("straightness", distortion.straightness, 0.0);
  require_above("evenness", distortion.evenness, 0.0);
  require_in_range("bend_share", distortion.bend_share, 0.0, 1.0);
}

void validate(const PenParams& pen) {
  require_at_least("min_stroke_px", pen.min_stroke_px, 1.0);
  require_at_least("max_stroke_px", pen.max_stroke_px, pen.min_stroke_px);
  require_at_least("wobble_px", pen.wobble_px, 0.0);
  require_above("wobble_length_px", pen.wobble_length_px, 0.0);
  require_at_least("end_error_px", pen.end_error_px, 0.0);
  require_at_least("rounding_px", pen.rounding_px, 0.0);
  require_in_range("one_go_share", pen.one_go_share, 0.0, 1.0);
  require_in_range("doubled_share", pen.doubled_share, 0.0, 1.0);
  require_in_range("thick_wall_share", pen.thick_wall_share, 0.0, 1.0);
  require_above("thick_wall_m", pen.thick_wall_m, 0.0);
  require_in_range("left_out_share", pen.left_out_share, 0.0, 1.0);
  require_in_range("shut_door_share", pen.shut_door_share, 0.0, 1.0);
  require_at_least("door_log_sigma", pen.door_log_sigma, 0.0);
  require_in_range("furniture_share", pen.furniture_share, 0.0, 1.0);
  require_at_least("max_margin_px", pen.max_margin_px, 0.0);
}

void validate(const PersonParams& person) {
  validate(person.distortion);
  validate(person.pen);
}

PersonParams human_person() { return {}; }

PersonParams tps_person() {
  return {.distortion = {.px_per_m = 20.0,
                         .px_per_m_log_sigma = 0.0,
                         .tilt_sigma_rad = 0.0,
                         .turned_share = 0.0,
                         .proportion_log_sigma = 0.0,
                         .room_log_sigma = 0.0,
                         .corridor_log_mean = 0.0,
                         .corridor_log_sigma = 0.0,
                         .room_shear_sigma = 0.0,
                         .bend_share = 0.05},
          .pen = {.min_stroke_px = 2.0,
                  .max_stroke_px = 2.0,
                  .wobble_px = 0.0,
                  .end_error_px = 0.0,
                  .rounding_px = 0.0,
                  .one_go_share = 1.0,
                  .doubled_share = 0.0,
                  .thick_wall_share = 0.0,
                  .left_out_share = 0.0,
                  .shut_door_share = 0.0,
                  .door_log_sigma = 0.0,
                  .furniture_share = 0.0}};
}

Drawing draw(const FloorPlan& plan, const PersonParams& person, Rng& rng) {
  validate(person);
  if (plan.rooms.empty() && plan.walls.empty()) {
    return {.status = Drawing::Status::NothingToDraw};
  }
  const PenParams& pen = person.pen;
  Deformation sketch_from_world = detail::distort(plan, person.distortion, rng);
  std::vector<Stroke> strokes;
  for (const Stroke& line : detail::choose_strokes(plan, pen, rng)) {
    const Stroke meant = distorted(line, sketch_from_world);
    strokes.push_back(detail::drawn_by_hand(meant, pen, rng));
    if (uniform(rng) < pen.doubled_share) {
      strokes.push_back(detail::drawn_by_hand(meant, pen, rng));
    }
  }
  if (strokes.empty()) {
    return {.status = Drawing::Status::NothingToDraw};
  }
  const PlaneBox paper = with_margins(bounds(strokes), pen, rng);
  const double stroke_width_px = uniform(pen.min_stroke_px, pen.max_stroke_px, rng);
  sketch_from_world.then(AffineMap{.shift = -paper.low});
  return {.sketch = {.occupied = ink(strokes, paper, stroke_width_px), .px_per_m = std::nullopt},
          .sketch_from_world = std::move(sketch_from_world)};
}

Drawing true_map(const Building& building) {
  const MetricMap& map = building.map;
  Drawing drawing{.sketch = {.occupied = map.cells, .px_per_m = 1.0 / map.cell_m}};
  for (int row = 0; row < drawing.sketch.occupied.height(); ++row) {
    for (std::uint8_t& cell : drawing.sketch.occupied.row(row)) {
      cell = cell != MetricMap::Free ? 1 : 0;
    }
  }
  drawing.sketch_from_world.then(AffineMap{.linear = Eigen::Matrix2d::Identity() / map.cell_m,
                                           .shift = -map.origin_in_world / map.cell_m});
  return drawing;
}

}  // namespace sketchloc
