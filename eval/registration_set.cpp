#include "eval/registration_set.hpp"

#include <cmath>
#include <utility>

#include "motion/angles.hpp"
#include "motion/check.hpp"
#include "motion/validate.hpp"
#include "registration/matched_odometry.hpp"

namespace sketchloc {
namespace {

RegistrationStep step_of(const RecentScans& recent, const ReferencePose& pose,
                         const Se2& odom_from_robot) {
  RegistrationStep step{.step = pose.step,
                        .sketch_from_robot = pose.sketch_from_robot,
                        .odom_from_robot = odom_from_robot,
                        .scans = {},
                        .robot_from_then = {}};
  for (const PlacedScan& placed : recent.placed()) {
    step.scans.push_back(*placed.scan);
    step.robot_from_then.push_back(placed.robot_from_then);
  }
  return step;
}

}  // namespace

std::vector<PlacedScan> RegistrationStep::submap() const {
  std::vector<PlacedScan> placed;
  for (std::size_t i = 0; i < scans.size(); ++i) {
    placed.push_back({.scan = &scans[i], .robot_from_then = robot_from_then[i]});
  }
  return placed;
}

void validate(const RegistrationSetParams& params) {
  require_at_least("step_spacing_m", params.step_spacing_m, 0.0);
  validate_part("recent", params.recent);
}

RegistrationSet make_registration_set(std::string name, std::string kind, Sketch sketch,
                                      const Run& run, const Reference& reference,
                                      const RegistrationSetParams& params) {
  validate(params);
  SketchCropper drawing(sketch);
  RegistrationSet set{.name = std::move(name),
                      .kind = std::move(kind),
                      .sketch = std::move(sketch),
                      .drawing = std::move(drawing),
                      .steps = {}};
  MatchedOdometry odometry;
  RecentScans recent(params.recent);
  auto pose = reference.poses.begin();
  for (std::size_t i = 0; i < run.steps.size() && pose != reference.poses.end(); ++i) {
    const RunStep& step = run.steps[i];
    const Se2 odom_from_robot = odometry.step(step.scan, step.odom_from_robot).odom_from_robot;
    recent.add(step.scan, odom_from_robot);
    if (pose->step != i) {
      continue;
    }
    const bool is_far =
        set.steps.empty() ||
        (set.steps.back().odom_from_robot.inverse() * odom_from_robot).translation().norm() >=
            params.step_spacing_m;
    if (pose->scored && is_far) {
      set.steps.push_back(step_of(recent, *pose, odom_from_robot));
    }
    ++pose;
  }
  return set;
}

RegistrationSet make_registration_set(std::string name, std::string kind, const DataSet& data_set,
                                      const RegistrationSetParams& params) {
  RegistrationSet set =
      make_registration_set(std::move(name), std::move(kind), data_set.drawing.sketch, data_set.run,
                            data_set.reference, params);
  set.sketch_from_world = data_set.drawing.sketch_from_world;
  for (const RegistrationStep& step : set.steps) {
    set.world_from_robot.push_back(data_set.world_from_robot[step.step].pose);
  }
  return set;
}

RegistrationError registration_error(const RegistrationSet& set, std::size_t index,
                                     const Sim2& sketch_from_robot) {
  const Sim2& truth = set.steps.at(index).sketch_from_robot;
  const RegistrationError in_sketch = {
      .position_m = (sketch_from_robot.translation() - truth.translation()).norm() / truth.scale(),
      .heading_rad = std::abs(wrap_rad(sketch_from_robot.yaw_rad() - truth.yaw_rad()))};
  if (!set.sketch_from_world) {
    return in_sketch;
  }
  const Se2& world_from_robot = set.world_from_robot.at(index);
  const Eigen::Vector2d guess =
      world_from_robot * (truth.inverse() * sketch_from_robot.translation());
  const Inversion here = invert(*set.sketch_from_world, sketch_from_robot.translation(), guess);
  if (here.status != Inversion::Status::Converged) {
    return in_sketch;  // outside of what the deformation can say
  }
  const double turned_rad =
      local_similarity(set.sketch_from_world->at(here.point).jacobian).rotation_rad;
  return {.position_m = (here.point - world_from_robot.translation()).norm(),
          .heading_rad = std::abs(
              wrap_rad(sketch_from_robot.yaw_rad() - turned_rad - world_from_robot.yaw_rad()))};
}

}  // namespace sketchloc
