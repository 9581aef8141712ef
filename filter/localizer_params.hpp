#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "filter/beam_model.hpp"
#include "filter/challengers.hpp"
#include "filter/end_point_model.hpp"
#include "filter/localized_belief.hpp"
#include "filter/mode_finder.hpp"
#include "filter/predict.hpp"
#include "filter/recovery.hpp"
#include "filter/registrar.hpp"
#include "filter/resample.hpp"
#include "registration/range_table.hpp"

namespace sketchloc {

/// When a scan is worth an update, and how much: the same evidence counts once, however often the
/// robot scans.
struct MotionGate {
  double way_m = 0.1;                 ///< since the last update, >= 0
  double turn_rad = 0.35;             ///< or turned by this much, >= 0
  double independent_way_m = 0.4;     ///< way after which a scan is all new; sooner, in part, > 0
  double independent_turn_rad = 0.7;  ///< or turned by this much, > 0
};

template <typename Visitor>
void visit_fields(MotionGate& gate, Visitor&& visit) {
  visit("way_m", gate.way_m);
  visit("turn_rad", gate.turn_rad);
  visit("independent_way_m", gate.independent_way_m);
  visit("independent_turn_rad", gate.independent_turn_rad);
}

void validate(const MotionGate& gate);

/// Spread of the particles around a given start, 1-sigma.
struct StartSpread {
  double position_m = 0.5;  ///< >= 0
  double heading_rad = 0.1;
  double log_scale = 0.1;       ///< of the local scale there
  double log_mean_scale = 0.3;  ///< of the drawing's mean scale against the local one
  double strain = 0.2;
};

template <typename Visitor>
void visit_fields(StartSpread& spread, Visitor&& visit) {
  visit("position_m", spread.position_m);
  visit("heading_rad", spread.heading_rad);
  visit("log_scale", spread.log_scale);
  visit("log_mean_scale", spread.log_mean_scale);
  visit("strain", spread.strain);
}

void validate(const StartSpread& spread);

/// What weighs the particles.
enum class Measurement {
  Beams,     ///< range-ratio beams: for drawings
  EndPoints  ///< end-point likelihood field: for maps in true proportions
};
std::span<const std::pair<std::string_view, Measurement>> names_of(Measurement);

struct LocalizerParams {
  PredictParams predict;
  Measurement measurement = Measurement::Beams;
  BeamModelParams beams;
  EndPointModelParams end_points;
  KldParams particles;
  ModeParams modes;
  MotionGate gate;
  StartSpread start;
  RecoveryParams recovery;
  FusionParams fusion;
  LocalizedParams localized;
  ChallengerParams challengers;
  RangeTableParams table;
  double resample_below = 0.5;  ///< share of effective particles that calls for resampling, [0, 1]
  std::uint64_t seed = 1;
  int jobs = 1;  ///< threads; the result does not depend on it, >= 1
};

/// All but seed and jobs, which do not tune.
template <typename Visitor>
void visit_fields(LocalizerParams& params, Visitor&& visit) {
  visit("predict", params.predict);
  visit("measurement", params.measurement);
  visit("beams", params.beams);
  visit("end_points", params.end_points);
  visit("particles", params.particles);
  visit("modes", params.modes);
  visit("gate", params.gate);
  visit("start", params.start);
  visit("recovery", params.recovery);
  visit("fusion", params.fusion);
  visit("localized", params.localized);
  visit("challengers", params.challengers);
  visit("table", params.table);
  visit("resample_below", params.resample_below);
}

/// The parameters for a map in true proportions: nothing deforms, end points are scored.
LocalizerParams metric_localizer_params();

/// Throws std::invalid_argument naming the component and field, its range and its value.
void validate(const LocalizerParams& params);

}  // namespace sketchloc
