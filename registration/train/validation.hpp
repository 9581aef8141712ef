#pragma once

#include <optional>
#include <span>
#include <vector>

#include "motion/sim2.hpp"
#include "registration/train/network_plan.hpp"

namespace sketchloc {

struct ValidationSummary {
  double mean = 0.0;
  double median = 0.0;
  double p90 = 0.0;
};

/// Errors of poses in true local metres, before (the prior) and after registration.
struct ValidationReport {
  int samples = 0;
  int failures = 0;  ///< samples without a pose; they count with the error of the prior
  ValidationSummary prior_position_m;
  ValidationSummary position_m;
  ValidationSummary prior_heading_rad;
  ValidationSummary heading_rad;
};

/// The pose that a network's output means; none where it means none.
std::optional<Sim2> pose_of(NetworkKind kind, std::span<const float> output,
                            const Sim2& prior_sketch_from_robot, const LocalWindow& window);

/// Collects errors of estimated poses.
class ValidationErrors {
 public:
  void add(const Sim2& truth, const Sim2& prior, const std::optional<Sim2>& estimate);
  ValidationReport report() const;

 private:
  int failures_ = 0;
  std::vector<double> prior_position_m_;
  std::vector<double> position_m_;
  std::vector<double> prior_heading_rad_;
  std::vector<double> heading_rad_;
};

}  // namespace sketchloc
