#pragma once

#include <memory>

#include "apps/learning_task.hpp"
#include "registration/train/node_pairs.hpp"
#include "registration/train/place_samples.hpp"
#include "registration/train/sample_source.hpp"

namespace sketchloc {

/// Learns to tell kinds of places by what a LIDAR sees.
std::unique_ptr<LearningTask> make_label_task(const PlaceSampleParams& samples,
                                              const LearningPlan& plan);

/// Learns to tell nodes of one place from others by where they lie.
std::unique_ptr<LearningTask> make_same_place_task(const NodePairParams& pairs,
                                                   const LearningPlan& plan);

/// Learns whether the robot is where its scans were registered, by the network of ours that comes
/// with the program; begins with what that one knows.
std::unique_ptr<LearningTask> make_verification_task(const SampleSourceParams& source,
                                                     const LearningPlan& plan);

}  // namespace sketchloc
