#pragma once

#include "datasets/sim/building.hpp"
#include "datasets/sim/deformation.hpp"
#include "datasets/sketch.hpp"
#include "motion/random.hpp"

namespace sketchloc {

/// How a person gets places and sizes wrong. Log sigmas are of factors: 0.3 means a third.
struct DistortionParams {
  double px_per_m = 17.0;              ///< median of drawings, > 0
  double px_per_m_log_sigma = 0.15;    ///< between drawings, >= 0
  double tilt_sigma_rad = 0.05;        ///< of the whole drawing against the axes, >= 0
  double turned_share = 0.5;           ///< drawings turned by 90, 180 or 270 deg, in [0, 1]
  double proportion_log_sigma = 0.15;  ///< of the whole drawing's width against its height, >= 0
  double room_log_sigma = 0.55;        ///< of each room's width and of its depth, >= 0
  double corridor_log_mean = 0.2;      ///< corridors are drawn wider than they are
  double corridor_log_sigma = 0.5;     ///< of each corridor's width, >= 0
  double room_shear_sigma = 0.25;      ///< slope of lines that should be at right angles, >= 0
  double straightness = 20.0;          ///< weight of keeping walls straight against room sizes, > 0
  double evenness = 0.12;              ///< weight of keeping rows in line elsewhere, > 0
  double bend_share = 0.025;           ///< spline displacement over the building's size, >= 0
};

template <typename Visitor>
void visit_fields(DistortionParams& distortion, Visitor&& visit) {
  visit("px_per_m", distortion.px_per_m);
  visit("px_per_m_log_sigma", distortion.px_per_m_log_sigma);
  visit("tilt_sigma_rad", distortion.tilt_sigma_rad);
  visit("turned_share", distortion.turned_share);
  visit("proportion_log_sigma", distortion.proportion_log_sigma);
  visit("room_log_sigma", distortion.room_log_sigma);
  visit("corridor_log_mean", distortion.corridor_log_mean);
  visit("corridor_log_sigma", distortion.corridor_log_sigma);
  visit("room_shear_sigma", distortion.room_shear_sigma);
  visit("straightness", distortion.straightness);
  visit("evenness", distortion.evenness);
  visit("bend_share", distortion.bend_share);
}

/// How a person moves the pen and what is left out.
struct PenParams {
  double min_stroke_px = 1.0;      ///< the pen's width is drawn once per drawing, >= 1
  double max_stroke_px = 5.0;      ///< >= min_stroke_px
  double wobble_px = 1.2;          ///< sideways error along a stroke, 1-sigma, >= 0
  double wobble_length_px = 35.0;  ///< way over which it changes, > 0
  double end_error_px = 3.0;       ///< strokes that end too early or too late, 1-sigma, >= 0
  double rounding_px = 5.0;        ///< corners drawn in one go are rounded this much, >= 0
  double one_go_share = 0.5;       ///< corners drawn without lifting the pen, in [0, 1]
  double doubled_share = 0.03;     ///< strokes drawn twice, in [0, 1]
  double thick_wall_share = 0.04;  ///< walls drawn as an outline, in [0, 1]
  double thick_wall_m = 0.6;       ///< mean width of such an outline, > 0
  double left_out_share = 0.03;    ///< inner walls not drawn, in [0, 1]
  double shut_door_share = 0.06;   ///< doors drawn shut, in [0, 1]
  double door_log_sigma = 0.3;     ///< of the width of door gaps, >= 0
  double furniture_share = 0.01;   ///< of the furniture that is drawn, in [0, 1]
  double max_margin_px = 60.0;     ///< empty paper around the drawing, >= 0
};

template <typename Visitor>
void visit_fields(PenParams& pen, Visitor&& visit) {
  visit("min_stroke_px", pen.min_stroke_px);
  visit("max_stroke_px", pen.max_stroke_px);
  visit("wobble_px", pen.wobble_px);
  visit("wobble_length_px", pen.wobble_length_px);
  visit("end_error_px", pen.end_error_px);
  visit("rounding_px", pen.rounding_px);
  visit("one_go_share", pen.one_go_share);
  visit("doubled_share", pen.doubled_share);
  visit("thick_wall_share", pen.thick_wall_share);
  visit("thick_wall_m", pen.thick_wall_m);
  visit("left_out_share", pen.left_out_share);
  visit("shut_door_share", pen.shut_door_share);
  visit("door_log_sigma", pen.door_log_sigma);
  visit("furniture_share", pen.furniture_share);
  visit("max_margin_px", pen.max_margin_px);
}

struct PersonParams {
  DistortionParams distortion;
  PenParams pen;
};

template <typename Visitor>
void visit_fields(PersonParams& person, Visitor&& visit) {
  visit("distortion", person.distortion);
  visit("pen", person.pen);
}

/// Throw std::invalid_argument naming the field, its range and its value.
void validate(const DistortionParams& distortion);
void validate(const PenParams& pen);
void validate(const PersonParams& person);

/// People who draw as measured on real drawings (docs/results/simulator.md).
PersonParams human_person();

/// The training drawings of [Chen20]: the exact plan under one random thin plate spline.
PersonParams tps_person();

/// A drawing with its truth.
struct Drawing {
  enum class Status {
    Drawn,
    NothingToDraw  ///< the plan has no lines, or the person left out all of them; no sketch
  };
  Sketch sketch{};
  Deformation sketch_from_world{};
  Status status = Status::Drawn;
};

/// A person's drawing of a building.
Drawing draw(const FloorPlan& plan, const PersonParams& person, Rng& rng);

/// The building's true map as a drawing: one px per cell, with the furniture, px_per_m known.
Drawing true_map(const Building& building);

}  // namespace sketchloc
