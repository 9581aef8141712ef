#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "motion/se2.hpp"
#include "motion/sim2.hpp"

namespace sketchloc {

/// A pose with its time. `Pose` is Se2 (metric frames) or Sim2 (poses in a drawing).
template <typename Pose>
struct Stamped {
  double time_s = 0.0;
  Pose pose;
};

/// Poses in strictly increasing time.
template <typename Pose>
class Trajectory {
 public:
  Trajectory() = default;
  /// Checks that the times increase strictly.
  explicit Trajectory(std::vector<Stamped<Pose>> poses);

  /// Checks that time_s is after the last one.
  void append(double time_s, const Pose& pose);

  std::size_t size() const { return poses_.size(); }
  bool empty() const { return poses_.empty(); }
  const Stamped<Pose>& operator[](std::size_t index) const { return poses_[index]; }
  auto begin() const { return poses_.begin(); }
  auto end() const { return poses_.end(); }

  /// The pose at a time by constant-twist interpolation; none outside the covered time.
  std::optional<Pose> at(double time_s) const;

 private:
  std::vector<Stamped<Pose>> poses_;
};

using MetricTrajectory = Trajectory<Se2>;
using SketchTrajectory = Trajectory<Sim2>;

extern template class Trajectory<Se2>;
extern template class Trajectory<Sim2>;

/// The poses without their times.
template <typename Pose>
std::vector<Pose> poses_of(const Trajectory<Pose>& trajectory) {
  std::vector<Pose> poses;
  poses.reserve(trajectory.size());
  for (const Stamped<Pose>& stamped : trajectory) {
    poses.push_back(stamped.pose);
  }
  return poses;
}

/// Index pairs (first, second) of times that lie closest together, at most max_gap_s apart, each
/// used once, closest pairs first served; no two pairs cross, so that the later of the first list
/// has the later of the second. Checks that neither list decreases.
std::vector<std::pair<std::size_t, std::size_t>> match_by_time(std::span<const double> first_s,
                                                               std::span<const double> second_s,
                                                               double max_gap_s);

/// The rigid motion that takes `from` onto `to` with the least squared error, in closed form.
/// Needs at least one pair of points; where nothing tells the turn (one pair, coincident points,
/// mirror images) it is a pure translation. [Umeyama91]
Se2 align_se2(std::span<const Eigen::Vector2d> from, std::span<const Eigen::Vector2d> to);

/// The same with a uniform scale; none where nothing tells the turn. [Umeyama91]
std::optional<Sim2> align_sim2(std::span<const Eigen::Vector2d> from,
                               std::span<const Eigen::Vector2d> to);

}  // namespace sketchloc
