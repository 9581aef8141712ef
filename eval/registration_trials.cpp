#include "eval/registration_trials.hpp"

#include <chrono>
#include <cmath>
#include <numbers>

#include "eval/nees.hpp"
#include "motion/angles.hpp"
#include "motion/number_text.hpp"
#include "motion/validate.hpp"
#include "registration/alignment.hpp"

namespace sketchloc {
namespace {

const LocalWindow kJudgedWindow{};  ///< alignment is compared in the same one for all methods

using Clock = std::chrono::steady_clock;

struct Answer {
  std::optional<Registration> registration;
  double milliseconds = 0.0;
};

Answer timed_answer(const RegistrationSet& set, std::size_t index,
                    const RegistrationMethodUse& method, const Sim2& prior) {
  const Clock::time_point begin = Clock::now();
  std::optional<Registration> registration = ask(set, index, method, prior);
  return {.registration = std::move(registration),
          .milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - begin).count()};
}

/// The error e of truth = estimate * e against its stated covariance.
void judge_covariance(RegistrationTrial& trial, const Registration& found, const Sim2& truth) {
  if (!found.covariance) {
    return;
  }
  const Sim2 off = found.sketch_from_robot.inverse() * truth;
  const Eigen::Vector3d error(off.x(), off.y(), off.yaw_rad());
  trial.nees_position =
      nees(error.head<2>(), Eigen::Matrix2d(found.covariance->topLeftCorner<2, 2>()));
  trial.nees_pose = nees(error, Eigen::Matrix3d(found.covariance->topLeftCorner<3, 3>()));
}

RegistrationTrial judge(const RegistrationSet& set, std::size_t index,
                        const RegistrationMethodUse& method, const std::string& protocol,
                        const Sim2& prior, const Answer& answer) {
  RegistrationTrial trial{.set = set.name,
                          .kind = set.kind,
                          .protocol = protocol,
                          .method = method.name,
                          .index = index,
                          .prior = registration_error(set, index, prior),
                          .found = answer.registration || method.predictor == nullptr,
                          .error = {},
                          .nees_position = {},
                          .nees_pose = {},
                          .milliseconds = answer.milliseconds};
  const Sim2& truth = set.steps[index].sketch_from_robot;
  const Sim2& pose = answer.registration ? answer.registration->sketch_from_robot : prior;
  trial.error = registration_error(set, index, pose);
  trial.log_scale_error = std::log(pose.scale() / truth.scale());
  const std::vector<PlacedScan> submap = set.steps[index].submap();
  trial.prior_alignment = alignment_score(submap, set.drawing, prior, kJudgedWindow);
  trial.alignment = alignment_score(submap, set.drawing, pose, kJudgedWindow);
  if (answer.registration) {
    trial.inlier_probability = answer.registration->inlier_probability;
    judge_covariance(trial, *answer.registration, truth);
  } else {
    trial.inlier_probability = method.predictor == nullptr ? 1.0 : 0.0;
  }
  return trial;
}

}  // namespace

void validate(const PriorSpread& spread) {
  require_at_least("shift_m", spread.shift_m, 0.0);
  require_in_range("turn_rad", spread.turn_rad, 0.0, std::numbers::pi);
  require_at_least("log_scale_sigma", spread.log_scale_sigma, 0.0);
}

Sim2 prior_around(const Sim2& sketch_from_robot, const PriorSpread& spread, Rng& rng) {
  const double share = spread.exact ? 1.0 : std::sqrt(uniform(rng));
  const double direction_rad = uniform(-std::numbers::pi, std::numbers::pi, rng);
  const double side = uniform(-1.0, 1.0, rng);
  const double turn_rad = spread.turn_rad * (spread.exact ? std::copysign(1.0, side) : side);
  const double log_scale = gaussian(spread.log_scale_sigma, rng);
  const double shift_m = share * spread.shift_m;
  return sketch_from_robot * Sim2::from_xy_yaw_scale(shift_m * std::cos(direction_rad),
                                                     shift_m * std::sin(direction_rad), turn_rad,
                                                     std::exp(log_scale));
}

std::vector<PlacedScan> submap_for(const RegistrationMethodUse& method,
                                   const RegistrationStep& step) {
  std::vector<PlacedScan> submap = step.submap();
  if (method.present_scan_only) {
    submap.resize(1);
  }
  return submap;
}

std::optional<Registration> ask(const RegistrationSet& set, std::size_t index,
                                const RegistrationMethodUse& method,
                                const Sim2& prior_sketch_from_robot) {
  if (method.predictor == nullptr) {
    return std::nullopt;
  }
  const std::vector<PlacedScan> submap = submap_for(method, set.steps.at(index));
  return method.predictor->predict(submap, set.drawing, {&prior_sketch_from_robot, 1}).front();
}

std::vector<RegistrationTrial> run_chained(const RegistrationSet& set,
                                           const RegistrationMethodUse& method) {
  std::vector<RegistrationTrial> trials;
  std::optional<Sim2> last;
  for (std::size_t i = 0; i < set.steps.size(); ++i) {
    const RegistrationStep& step = set.steps[i];
    const Sim2 prior =
        last ? *last * (set.steps[i - 1].odom_from_robot.inverse() * step.odom_from_robot)
             : step.sketch_from_robot;
    const Answer answer = timed_answer(set, i, method, prior);
    trials.push_back(judge(set, i, method, "chained", prior, answer));
    last = answer.registration ? answer.registration->sketch_from_robot : prior;
  }
  return trials;
}

std::vector<RegistrationTrial> run_around_truth(const RegistrationSet& set,
                                                const RegistrationMethodUse& method,
                                                const std::string& protocol,
                                                const PriorSpread& spread, std::uint64_t seed) {
  std::vector<RegistrationTrial> trials;
  for (std::size_t i = 0; i < set.steps.size(); ++i) {
    Rng rng = make_rng(seed, i);
    const Sim2 prior = prior_around(set.steps[i].sketch_from_robot, spread, rng);
    trials.push_back(judge(set, i, method, protocol, prior, timed_answer(set, i, method, prior)));
  }
  return trials;
}

std::string trials_csv(std::span<const RegistrationTrial> trials) {
  std::string text =
      "set,kind,protocol,method,index,prior_m,prior_deg,found,error_m,error_deg,log_scale_error,"
      "nees_position,nees_pose,inlier_probability,prior_alignment,alignment\n";
  for (const RegistrationTrial& trial : trials) {
    text += trial.set + "," + trial.kind + "," + trial.protocol + "," + trial.method + "," +
            std::to_string(trial.index);
    const auto add = [&](std::optional<double> value) {
      text += "," + (value ? number_text(*value) : std::string());
    };
    add(trial.prior.position_m);
    add(deg_from_rad(trial.prior.heading_rad));
    add(trial.found ? 1.0 : 0.0);
    add(trial.error.position_m);
    add(deg_from_rad(trial.error.heading_rad));
    add(trial.log_scale_error);
    add(trial.nees_position);
    add(trial.nees_pose);
    add(trial.inlier_probability);
    add(trial.prior_alignment);
    add(trial.alignment);
    text += "\n";
  }
  return text;
}

}  // namespace sketchloc
