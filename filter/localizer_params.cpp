#include "filter/localizer_params.hpp"

#include "motion/validate.hpp"

namespace sketchloc {

void validate(const MotionGate& gate) {
  require_at_least("way_m", gate.way_m, 0.0);
  require_at_least("turn_rad", gate.turn_rad, 0.0);
  require_above("independent_way_m", gate.independent_way_m, 0.0);
  require_above("independent_turn_rad", gate.independent_turn_rad, 0.0);
}

void validate(const StartSpread& spread) {
  require_at_least("position_m", spread.position_m, 0.0);
  require_at_least("heading_rad", spread.heading_rad, 0.0);
  require_at_least("log_scale", spread.log_scale, 0.0);
  require_at_least("log_mean_scale", spread.log_mean_scale, 0.0);
  require_at_least("strain", spread.strain, 0.0);
}

void validate(const LocalizerParams& params) {
  validate_part("predict", params.predict);
  validate_part("beams", params.beams);
  validate_part("end_points", params.end_points);
  validate_part("particles", params.particles);
  validate_part("modes", params.modes);
  validate_part("gate", params.gate);
  validate_part("start", params.start);
  validate_part("recovery", params.recovery);
  validate_part("fusion", params.fusion);
  validate_part("localized", params.localized);
  validate_part("challengers", params.challengers);
  validate_part("table", params.table);
  require_in_range("resample_below", params.resample_below, 0.0, 1.0);
  require_in_range("jobs", params.jobs, 1, 1024);
}

std::span<const std::pair<std::string_view, Measurement>> names_of(Measurement) {
  static constexpr std::pair<std::string_view, Measurement> kNames[] = {
      {"beams", Measurement::Beams}, {"end_points", Measurement::EndPoints}};
  return kNames;
}

LocalizerParams metric_localizer_params() {
  LocalizerParams params;
  params.predict = metric_motion();
  params.measurement = Measurement::EndPoints;
  params.modes.radius_m = 1.0;
  params.particles.max_particles = 10000;  // a similarity less to sample than in a drawing
  params.gate.independent_way_m = params.gate.way_m;  // what errs is mostly the range noise
  params.gate.independent_turn_rad = params.gate.turn_rad;
  params.start = {.position_m = 0.3,
                  .heading_rad = 0.1,
                  .log_scale = 0.0,
                  .log_mean_scale = 0.0,
                  .strain = 0.0};
  return params;
}

}  // namespace sketchloc
