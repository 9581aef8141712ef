#include "filter/registrar.hpp"

#include <algorithm>
#include <cmath>

#include "motion/angles.hpp"
#include "motion/validate.hpp"

namespace sketchloc {

void validate(const FusionParams& fusion) {
  require_above("way_m", fusion.way_m, 0.0);
  require_above("turn_rad", fusion.turn_rad, 0.0);
  require_above("independent_way_m", fusion.independent_way_m, 0.0);
  require_above("independent_turn_rad", fusion.independent_turn_rad, 0.0);
  require_in_range("max_modes", fusion.max_modes, 1, 16);
  validate_part("trust", fusion.trust);
  validate_part("recent", fusion.recent);
}

Registrar::Registrar(const Sketch& sketch, WarpPredictor& predictor, const FusionParams& params)
    : params_((validate(params), params)),
      predictor_(&predictor),
      cropper_(sketch),
      recent_(params.recent) {}

void Registrar::forget() {
  recent_ = RecentScans(params_.recent);
  looked_once_ = false;
  way_since_m_ = 0.0;
  turn_since_rad_ = 0.0;
}

void Registrar::save(StateWriter& state) const {
  recent_.save(state);
  state.put(looked_once_);
  state.put(way_since_m_);
  state.put(turn_since_rad_);
}

void Registrar::load(StateReader& state) {
  recent_.load(state);
  looked_once_ = state.get<bool>();
  way_since_m_ = state.get_finite();
  turn_since_rad_ = state.get_finite();
}

void Registrar::add(const Scan& scan, const Se2& odom_from_robot, const Se2& last_from_robot) {
  recent_.add(scan, odom_from_robot);
  saw_anything_ = !end_points_in_robot(scan).empty();
  way_since_m_ += last_from_robot.translation().norm();
  turn_since_rad_ += std::abs(last_from_robot.yaw_rad());
}

bool Registrar::is_due() const {
  return saw_anything_ &&
         (!looked_once_ || way_since_m_ >= params_.way_m || turn_since_rad_ >= params_.turn_rad);
}

void Registrar::look(std::span<const Mode> modes, const Se2& then_from_robot) {
  modes_.clear();
  registrations_.clear();
  likelihoods_.clear();
  std::vector<Sim2> priors;
  for (const Mode& mode :
       modes.first(std::min(modes.size(), static_cast<std::size_t>(params_.max_modes)))) {
    priors.push_back(mode.sketch_from_robot * then_from_robot);
  }
  const auto found = predictor_->predict(recent_.placed(), cropper_, priors);
  const double share = looked_once_
                           ? std::min(1.0, way_since_m_ / params_.independent_way_m +
                                               turn_since_rad_ / params_.independent_turn_rad)
                           : 1.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i] && found[i]->covariance && found[i]->covariance->allFinite()) {
      modes_.push_back(modes[i].sketch_from_robot);
      registrations_.push_back(*found[i]);
      likelihoods_.push_back(pose_likelihood(*found[i], params_.trust, share));
    }
  }
  if (!likelihoods_.empty()) {
    looked_once_ = true;
    way_since_m_ = 0.0;
    turn_since_rad_ = 0.0;
  }
}

void Registrar::assign(const ParticleSet& particles, const ModeParams& modes,
                       std::vector<std::int8_t>& likelihood_of) const {
  likelihood_of.assign(particles.size(), kNoLikelihood);
  std::vector<double> nearest(particles.size(), 1.0);
  for (std::size_t mode = 0; mode < modes_.size(); ++mode) {
    const Sim2& pose = modes_[mode];
    const double per_px = 1.0 / (modes.radius_m * pose.scale());
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const double turn_rad =
          wrap_rad(static_cast<double>(particles.heading_rad[i]) - pose.yaw_rad());
      const double away =
          std::hypot(particles.x_px[i] - pose.x(), particles.y_px[i] - pose.y()) * per_px;
      if (away < nearest[i] && std::abs(turn_rad) < modes.radius_rad) {
        nearest[i] = away;
        likelihood_of[i] = static_cast<std::int8_t>(mode);
      }
    }
  }
}

}  // namespace sketchloc
