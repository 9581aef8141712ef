#include "registration/train/validation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "motion/angles.hpp"
#include "registration/network_output.hpp"

namespace sketchloc {
namespace {

ValidationSummary summarise(std::vector<double> errors) {
  if (errors.empty()) {
    return {};
  }
  std::sort(errors.begin(), errors.end());
  const auto at = [&](double share) {
    return errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
  };
  const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
  return {.mean = sum / static_cast<double>(errors.size()), .median = at(0.5), .p90 = at(0.9)};
}

double position_error_m(const Sim2& truth, const Sim2& estimate) {
  return (truth.translation() - estimate.translation()).norm() / truth.scale();
}

double heading_error_rad(const Sim2& truth, const Sim2& estimate) {
  return std::abs(wrap_rad(truth.yaw_rad() - estimate.yaw_rad()));
}

}  // namespace

std::optional<Sim2> pose_of(NetworkKind kind, std::span<const float> output,
                            const Sim2& prior_sketch_from_robot, const LocalWindow& window) {
  const Eigen::Vector2d& centre = prior_sketch_from_robot.translation();
  switch (kind) {
    case NetworkKind::Chen20:
      return pose_of_published(output, centre, window);
    case NetworkKind::Affine:
      return pose_of_published(sources_of_affine(output), centre, window);
    case NetworkKind::Ours:
      return pose_of_residual(output, prior_sketch_from_robot, window);
  }
  return std::nullopt;
}

void ValidationErrors::add(const Sim2& truth, const Sim2& prior,
                           const std::optional<Sim2>& estimate) {
  const Sim2& reached = estimate.value_or(prior);
  failures_ += estimate ? 0 : 1;
  prior_position_m_.push_back(position_error_m(truth, prior));
  position_m_.push_back(position_error_m(truth, reached));
  prior_heading_rad_.push_back(heading_error_rad(truth, prior));
  heading_rad_.push_back(heading_error_rad(truth, reached));
}

ValidationReport ValidationErrors::report() const {
  return {.samples = static_cast<int>(position_m_.size()),
          .failures = failures_,
          .prior_position_m = summarise(prior_position_m_),
          .position_m = summarise(position_m_),
          .prior_heading_rad = summarise(prior_heading_rad_),
          .heading_rad = summarise(heading_rad_)};
}

}  // namespace sketchloc
