#include "smoothing/keyframe_window.hpp"

#include <algorithm>
#include <cmath>

#include "motion/angles.hpp"
#include "motion/check.hpp"
#include "motion/odometry.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

/// Scans less than this apart show the same: a robot that stands needs no memory.
constexpr double kApartM = 0.02;
constexpr double kApartRad = 0.02;

/// Way that the scans on one side of a keyframe take up.
double side_way_m(const KeyframeParams& params) {
  return params.submap.spacing_m * (params.submap.max_scans - 1);
}

std::vector<Sim2> poses_of(std::span<const PoseHypothesis> hypotheses) {
  std::vector<Sim2> poses;
  for (const PoseHypothesis& one : hypotheses) {
    poses.push_back(one.sketch_from_robot);
  }
  return poses;
}

}  // namespace

void validate(const HindsightParams& params) {
  require_above("known_m", params.known_m, 0.0);
  require_above("known_rad", params.known_rad, 0.0);
}

KeyframeWindow::KeyframeWindow(const SketchCropper& drawing, WarpPredictor& predictor,
                               const KeyframeParams& params, const HindsightParams& hindsight)
    : drawing_(drawing),
      predictor_(&predictor),
      params_((validate(params), params)),
      hindsight_((validate(hindsight), hindsight)) {}

std::size_t KeyframeWindow::index_of(std::size_t keyframe) const {
  check(keyframe >= first() && keyframe < end(), "a keyframe of the window");
  return keyframe - first_;
}

const Keyframe& KeyframeWindow::at(std::size_t keyframe) const {
  return keyframes_[index_of(keyframe)];
}

const std::vector<PoseHypothesis>& KeyframeWindow::believed_at(std::size_t keyframe) const {
  return places_[index_of(keyframe)].believed;
}

double KeyframeWindow::way_m(std::size_t keyframe) const {
  return places_[index_of(keyframe)].way_m;
}

bool KeyframeWindow::saw_all_after(std::size_t keyframe) const {
  return way_m_ - way_m(keyframe) >= side_way_m(params_);
}

/// Counts the way to this scan, if it is any.
bool KeyframeWindow::moves(const RunStep& step) {
  if (scans_.empty()) {
    return true;
  }
  const Se2 moved = odometry_increment(scans_.back().odom_from_robot, step.odom_from_robot);
  const double way_m = moved.translation().norm();
  if (way_m < kApartM && std::abs(moved.yaw_rad()) < kApartRad) {
    return false;
  }
  way_m_ += way_m;
  keyframe_way_m_ += way_m;
  keyframe_turn_rad_ += std::abs(moved.yaw_rad());
  return true;
}

bool KeyframeWindow::add(const RunStep& step, std::span<const PoseHypothesis> believed) {
  check(!believed.empty(), "what the filter believes");
  const std::size_t number = steps_++;
  const bool is_first = scans_.empty();
  if (!moves(step)) {
    return false;
  }
  scans_.push_back(step);
  if (!is_first && keyframe_way_m_ < params_.way_m && keyframe_turn_rad_ < params_.turn_rad) {
    return false;
  }
  keyframes_.push_back({.step = number,
                        .time_s = step.scan.time_s,
                        .odom_from_robot = step.odom_from_robot,
                        .way_m = keyframe_way_m_,
                        .turn_rad = keyframe_turn_rad_});
  places_.push_back({.way_m = way_m_,
                     .scan = scans_forgotten_ + scans_.size() - 1,
                     .believed = {believed.begin(), believed.end()}});
  keyframe_way_m_ = 0.0;
  keyframe_turn_rad_ = 0.0;
  return true;
}

std::vector<PoseHypothesis> KeyframeWindow::register_side(std::size_t keyframe, Around which,
                                                          std::span<const Sim2> priors) const {
  return register_at(submap_around(scans_, scan_of(keyframe), which, params_.submap), drawing_,
                     *predictor_, priors);
}

void KeyframeWindow::look_as_it_came(std::size_t keyframe) {
  const std::size_t k = index_of(keyframe);
  keyframes_[k].hypotheses = register_side(keyframe, Around::Before, poses_of(places_[k].believed));
}

bool KeyframeWindow::has_looked_from(const Place& place, const Sim2& prior) const {
  return std::ranges::any_of(place.looked_back_from, [&](const Sim2& earlier) {
    const Sim2 off = earlier.inverse() * prior;
    return off.translation().norm() <= hindsight_.known_m &&
           std::abs(off.yaw_rad()) <= hindsight_.known_rad;
  });
}

void KeyframeWindow::look_back(std::size_t keyframe, std::span<const Sim2> priors) {
  const std::size_t k = index_of(keyframe);
  std::vector<Sim2> anew;
  for (const Sim2& prior : priors) {
    if (!has_looked_from(places_[k], prior)) {
      anew.push_back(prior);
      places_[k].looked_back_from.push_back(prior);
    }
  }
  for (const Around which : {Around::After, Around::Both}) {
    const std::vector<PoseHypothesis> found = register_side(keyframe, which, anew);
    keyframes_[k].hypotheses.insert(keyframes_[k].hypotheses.end(), found.begin(), found.end());
  }
}

std::span<const RunStep> KeyframeWindow::scans_until(std::size_t keyframe) const {
  return std::span(scans_).first(scan_of(keyframe) + 1);
}

std::size_t KeyframeWindow::scan_of(std::size_t keyframe) const {
  return places_[index_of(keyframe)].scan - scans_forgotten_;
}

void KeyframeWindow::forget_before(std::size_t keyframe) {
  const auto count = static_cast<std::ptrdiff_t>(index_of(keyframe));
  keyframes_.erase(keyframes_.begin(), keyframes_.begin() + count);
  places_.erase(places_.begin(), places_.begin() + count);
  first_ = keyframe;
  const std::size_t unneeded = places_.front().scan - scans_forgotten_;
  scans_.erase(scans_.begin(), scans_.begin() + static_cast<std::ptrdiff_t>(unneeded));
  scans_forgotten_ += unneeded;
}

}  // namespace sketchloc
