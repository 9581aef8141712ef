// What a localizer knows between two steps, as bytes; and what is done to it between steps.
#include <algorithm>
#include <stdexcept>

#include "filter/detail/chunks.hpp"
#include "filter/localizer.hpp"
#include "motion/angles.hpp"

namespace sketchloc {
namespace {

constexpr std::uint64_t kSpreadStream = 3ULL << 32;  // far from the numbers of the steps' engines

void save_estimate(const Estimate& estimate, StateWriter& state) {
  state.put(estimate.sketch_from_robot);
  state.put(estimate.covariance);
  state.put<std::uint64_t>(estimate.modes.size());
  for (const Mode& mode : estimate.modes) {
    state.put(mode.sketch_from_robot);
    state.put(mode.covariance);
    state.put(mode.weight);
  }
}

/// Keeps the memory of the estimate's modes.
void load_estimate(Estimate& estimate, std::size_t most_modes, StateReader& state) {
  estimate.sketch_from_robot = state.get_sim2();
  estimate.covariance = state.get_matrix<4, 4>();
  estimate.modes.resize(state.get_count(most_modes));
  for (Mode& mode : estimate.modes) {
    mode.sketch_from_robot = state.get_sim2();
    mode.covariance = state.get_matrix<4, 4>();
    mode.weight = state.get_finite();
  }
}

}  // namespace

void Localizer::save(StateWriter& state) const {
  particles_.save(state);
  evidence_.save(state);
  state.put(registrar_.has_value());
  if (registrar_) {
    registrar_->save(state);
  }
  state.put(last_odom_from_robot_);
  state.put<std::uint64_t>(steps_);
  state.put(way_since_update_m_);
  state.put(turn_since_update_rad_);
  state.put(updated_once_);
  save_estimate(report_.estimate, state);
  belief_.save(state);
  state.put(established_);
  challengers_.save(state);
  state.put(report_.localized_probability);
  state.put(update_share_);
  state.put(way_since_signs_m_);
  state.put(last_scan_from_robot_);
  if (last_scan_from_robot_) {
    sketchloc::save(last_scan_, state);
  }
}

void Localizer::load(StateReader& state) {
  forget();
  particles_.load(state, scores_.size());
  evidence_.load(state);
  if (state.get<bool>() != registrar_.has_value()) {
    throw std::runtime_error("the state is of a localizer with other registrations");
  }
  if (registrar_) {
    registrar_->load(state);
  }
  last_odom_from_robot_ = state.get_optional_se2();
  steps_ = state.get<std::uint64_t>();
  way_since_update_m_ = state.get_finite();
  turn_since_update_rad_ = state.get_finite();
  updated_once_ = state.get<bool>();
  load_estimate(report_.estimate, static_cast<std::size_t>(params_.modes.max_modes), state);
  belief_.load(state);
  established_ = state.get<bool>();
  challengers_.load(state);
  report_.localized_probability = state.get_finite();
  update_share_ = state.get_finite();
  way_since_signs_m_ = state.get_finite();
  last_scan_from_robot_ = state.get_optional_se2();
  if (last_scan_from_robot_) {
    last_scan_ = load_scan(state);
  }
}

void Localizer::spread(double position_m, double heading_rad) {
  for_each_chunk(particles_.size(), params_.jobs, [&](std::size_t chunk, ParticleRange range) {
    Rng rng = make_rng(params_.seed, kSpreadStream + steps_, chunk);
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const double position_px = position_m * std::exp(particles_.log_scale[i]);
      particles_.x_px[i] += static_cast<float>(gaussian(position_px, rng));
      particles_.y_px[i] += static_cast<float>(gaussian(position_px, rng));
      particles_.heading_rad[i] =
          static_cast<float>(wrap_rad(particles_.heading_rad[i] + gaussian(heading_rad, rng)));
    }
  });
}

}  // namespace sketchloc
