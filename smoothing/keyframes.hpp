#pragma once

#include <functional>
#include <span>
#include <vector>

#include "datasets/run.hpp"
#include "registration/recent_scans.hpp"
#include "registration/sketch_crop.hpp"
#include "registration/warp_predictor.hpp"
#include "smoothing/keyframe.hpp"

namespace sketchloc {

/// Which instants are keyframes, and what is registered there.
struct KeyframeParams {
  double way_m = 0.5;          ///< between keyframes, > 0
  double turn_rad = 0.8;       ///< or turned by this much, > 0
  RecentScansParams submap{};  ///< on each side in time
};

template <typename Visitor>
void visit_fields(KeyframeParams& params, Visitor&& visit) {
  visit("way_m", params.way_m);
  visit("turn_rad", params.turn_rad);
  visit("submap", params.submap);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const KeyframeParams& params);

/// The scans around a step, that one first, then outwards in time.
enum class Around { Before, After, Both };
std::vector<PlacedScan> submap_around(std::span<const RunStep> steps, std::size_t step,
                                      Around which, const RecentScansParams& params);

/// Registers a submap from prior poses; what a registration says of its pose is a hypothesis.
std::vector<PoseHypothesis> register_at(std::span<const PlacedScan> submap,
                                        const SketchCropper& drawing, WarpPredictor& predictor,
                                        std::span<const Sim2> priors_sketch_from_robot);

}  // namespace sketchloc
