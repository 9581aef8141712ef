#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "apps/learning_task.hpp"
#include "registration/network_kind.hpp"
#include "registration/train/sample_source.hpp"

namespace sketchloc {

struct RegistrationLearning {
  NetworkKind kind = NetworkKind::Ours;
  SampleSourceParams source = {};
  std::uint64_t improve_after = 0;  ///< samples; then ours improves its own priors
  /// The bytes of a trained network of this kind to go on from, whose looks improve priors from
  /// the first sample on; empty: begin with random numbers.
  std::string from = {};
};

/// Learns to register scans in drawings. Throws std::runtime_error where `from` is not a network
/// of this kind.
std::unique_ptr<LearningTask> make_registration_task(const RegistrationLearning& learning,
                                                     const LearningPlan& plan);

}  // namespace sketchloc
