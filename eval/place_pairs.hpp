#pragma once

#include <vector>

#include "datasets/run.hpp"
#include "smoothing/keyframe.hpp"
#include "topology/place_classifier.hpp"
#include "topology/recovered_run.hpp"

namespace sketchloc {

/// How the building's topology tells which keyframes are one place.
struct PlacePairParams {
  TopologyParams topology = matched_topology_params();
  PlaceClassifierParams classifier = {};
  double max_probability = 0.9;  ///< no pair is surer, in (0, 1)
};

template <typename Visitor>
void visit_fields(PlacePairParams& params, Visitor&& visit) {
  visit("topology", params.topology);
  visit("classifier", params.classifier);
  visit("max_probability", params.max_probability);
}

/// Throws std::invalid_argument naming the component and field, its range and its value.
void validate(const PlacePairParams& params);

/// Keyframes that are beside each other in the building, found without the drawing: scans tell the
/// kinds of places, right angles and matched odometry where they lie in metres. The run has matched
/// odometry.
std::vector<KeyframePair> place_pairs(const Run& run, const std::vector<Keyframe>& keyframes,
                                      const PlacePairParams& params = {});

}  // namespace sketchloc
