#include "eval/place_pairs.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "motion/validate.hpp"
#include "registration/shipped_networks.hpp"

namespace sketchloc {
namespace {

struct SeenSteps {
  std::vector<Scan> scans;
  std::vector<Se2> odom_from_robot;
};

SeenSteps seen_steps(const Run& run) {
  SeenSteps seen;
  for (const RunStep& step : run.steps) {
    seen.scans.push_back(step.scan);
    seen.odom_from_robot.push_back(step.odom_from_robot);
  }
  return seen;
}

/// The keyframe whose step is nearest to a step of the run.
std::size_t keyframe_near(const std::vector<Keyframe>& keyframes, std::size_t step) {
  const auto after = std::ranges::lower_bound(keyframes, step, {}, &Keyframe::step);
  if (after == keyframes.begin()) {
    return 0;
  }
  const auto before = after - 1;
  const bool nearer_before = after == keyframes.end() || step - before->step < after->step - step;
  return static_cast<std::size_t>((nearer_before ? before : after) - keyframes.begin());
}

}  // namespace

void validate(const PlacePairParams& params) {
  validate_part("topology", params.topology);
  validate_part("classifier", params.classifier);
  require_in_range("max_probability", params.max_probability, 0.01, 0.999);
}

std::vector<KeyframePair> place_pairs(const Run& run, const std::vector<Keyframe>& keyframes,
                                      const PlacePairParams& params) {
  const SeenSteps seen = seen_steps(run);
  PlaceClassifier classifier(shipped_place_classifier(), params.classifier);
  const RecoveredRun recovered = recover_run(
      seen.odom_from_robot, classify_places(classifier, seen.scans, seen.odom_from_robot),
      params.topology, TopologyStage::Feedback, seen.scans);
  std::vector<KeyframePair> pairs;
  std::set<std::pair<std::size_t, std::size_t>> known;
  for (const SamePlacePair& place : recovered.pairs) {
    for (const PosesBeside& beside : place.beside) {
      const std::size_t earlier = keyframe_near(keyframes, beside.earlier);
      const std::size_t later = keyframe_near(keyframes, beside.later);
      if (earlier == later || !known.emplace(earlier, later).second) {
        continue;
      }
      const Se2& earlier_pose = recovered.manhattan_from_robot[keyframes[earlier].step];
      const Se2& later_pose = recovered.manhattan_from_robot[keyframes[later].step];
      pairs.push_back({.earlier = earlier,
                       .later = later,
                       .earlier_from_later = earlier_pose.inverse() * later_pose,
                       .probability = std::min(place.probability, params.max_probability)});
    }
  }
  return pairs;
}

}  // namespace sketchloc
