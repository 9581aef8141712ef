#pragma once

#include <cstdint>
#include <memory>

#include "apps/learning_task.hpp"
#include "registration/network_kind.hpp"
#include "registration/train/sample_source.hpp"

namespace sketchloc {

struct RegistrationLearning {
  NetworkKind kind = NetworkKind::Ours;
  SampleSourceParams source = {};
  std::uint64_t improve_after = 0;  ///< samples; then ours improves its own priors
};

/// Learns to register scans in drawings.
std::unique_ptr<LearningTask> make_registration_task(const RegistrationLearning& learning,
                                                     const LearningPlan& plan);

}  // namespace sketchloc
