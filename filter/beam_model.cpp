#include "filter/beam_model.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "motion/validate.hpp"

namespace sketchloc {
namespace {

constexpr double kLeastRangeM = 1e-3;  ///< the robot may stand on its own laser's end point

Beam beam_to(const Eigen::Vector2d& end_in_robot, bool returned) {
  return {.bearing_rad = static_cast<float>(std::atan2(end_in_robot.y(), end_in_robot.x())),
          .range_m = static_cast<float>(std::max(end_in_robot.norm(), kLeastRangeM)),
          .returned = returned};
}

}  // namespace

void validate(const BeamModelParams& params) {
  validate_part("selection", params.selection);
  validate_part("kernel", params.kernel);
  require_in_range("exponent", params.exponent, 1e-6, 1.0);
}

BeamModel::BeamModel(const RangeTable& table, const BeamModelParams& params)
    : params_((validate(params), params)), kernel_(table, params.kernel) {}

std::size_t BeamModel::observe(const Scan& scan) {
  select_beams(selected_, scan, params_.selection);
  beams_.clear();
  for (const auto& [end, returned] : selected_) {
    beams_.push_back(beam_to(end, returned));
  }
  kernel_.prepare(beams_, prepared_);
  return beams_.size();
}

std::optional<PreparedBeams> BeamModel::unbent(const Registration& registration) const {
  const Warp& warp = registration.warp;
  const LocalWindow& window = registration.window;
  const std::optional<PlaneMapPoint> robot = warp.sketch_from_robot(Eigen::Vector2d::Zero());
  if (!robot || !(robot->jacobian.determinant() > 0.0)) {
    return std::nullopt;
  }
  const Eigen::Matrix2d robot_from_sketch = robot->jacobian.inverse();
  std::vector<Beam> beams;
  for (const auto& [end, returned] : selected_) {
    const bool inside =
        (end - window.centre_in_robot()).cwiseAbs().maxCoeff() <= 0.5 * window.side_m;
    const auto place = inside ? warp.sketch_from_robot(end) : std::optional<PlaneMapPoint>();
    const bool known = place && place->value.allFinite();
    beams.push_back(
        beam_to(known ? Eigen::Vector2d(robot_from_sketch * (place->value - robot->value)) : end,
                returned));
  }
  PreparedBeams prepared;
  kernel_.prepare(beams, prepared);
  return prepared;
}

void BeamModel::score(const ParticleSet& particles, const ParticleRange& range,
                      std::span<float> log_likelihood) const {
  score(particles, range, prepared_, log_likelihood);
}

void BeamModel::score(const ParticleSet& particles, const ParticleRange& range,
                      const PreparedBeams& beams, std::span<float> log_likelihood) const {
  const std::size_t count = range.end - range.begin;
  kernel_.score(particles.spans().subspan(range.begin, count), beams,
                log_likelihood.subspan(range.begin, count));
}

}  // namespace sketchloc
