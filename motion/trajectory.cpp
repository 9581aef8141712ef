#include "motion/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "motion/check.hpp"
#include "motion/detail/complex_plane.hpp"

namespace sketchloc {

template <typename Pose>
Trajectory<Pose>::Trajectory(std::vector<Stamped<Pose>> poses) : poses_(std::move(poses)) {
  for (std::size_t i = 1; i < poses_.size(); ++i) {
    check(poses_[i - 1].time_s < poses_[i].time_s, "the times of a trajectory must increase");
  }
}

template <typename Pose>
void Trajectory<Pose>::append(double time_s, const Pose& pose) {
  check(poses_.empty() || poses_.back().time_s < time_s, "the times of a trajectory must increase");
  poses_.push_back({.time_s = time_s, .pose = pose});
}

template <typename Pose>
std::optional<Pose> Trajectory<Pose>::at(double time_s) const {
  const auto after = std::ranges::lower_bound(poses_, time_s, {}, &Stamped<Pose>::time_s);
  if (after == poses_.end() || (after == poses_.begin() && after->time_s != time_s)) {
    return std::nullopt;
  }
  if (after->time_s == time_s) {
    return after->pose;
  }
  const Stamped<Pose>& before = *std::prev(after);
  const double share = (time_s - before.time_s) / (after->time_s - before.time_s);
  return interpolate(before.pose, after->pose, share);
}

template class Trajectory<Se2>;
template class Trajectory<Sim2>;

namespace {

/// A time of one of two lists.
struct ListedTime {
  double time_s = 0.0;
  std::size_t among_equals = 0;  ///< how many of its list are equal and before it
  std::size_t index = 0;
  bool of_first = false;
};

void append(std::vector<ListedTime>& merged, std::span<const double> times_s, bool of_first) {
  std::size_t equals = 0;
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    equals = i > 0 && times_s[i] == times_s[i - 1] ? equals + 1 : 0;
    merged.push_back(
        {.time_s = times_s[i], .among_equals = equals, .index = i, .of_first = of_first});
  }
}

/// Both lists in the order of time, those at one time by turns.
std::vector<ListedTime> merged_times(std::span<const double> first_s,
                                     std::span<const double> second_s) {
  std::vector<ListedTime> merged;
  append(merged, first_s, true);
  append(merged, second_s, false);
  std::ranges::stable_sort(merged, {}, [](const ListedTime& listed) {
    return std::pair(listed.time_s, listed.among_equals);
  });
  return merged;
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> match_by_time(std::span<const double> first_s,
                                                               std::span<const double> second_s,
                                                               double max_gap_s) {
  check(std::ranges::is_sorted(first_s) && std::ranges::is_sorted(second_s),
        "times to match must not decrease");
  const std::vector<ListedTime> merged = merged_times(first_s, second_s);
  // A pair around another one would cross it, so only neighbours can be pairs.
  std::vector<std::pair<double, std::size_t>> proposals;  // gap, left one of the neighbours
  for (std::size_t i = 0; i + 1 < merged.size(); ++i) {
    const double gap_s = merged[i + 1].time_s - merged[i].time_s;
    if (merged[i].of_first != merged[i + 1].of_first && gap_s <= max_gap_s) {
      proposals.emplace_back(gap_s, i);
    }
  }
  std::ranges::sort(proposals);
  std::vector<bool> taken(merged.size(), false);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [gap_s, left] : proposals) {
    if (!taken[left] && !taken[left + 1]) {
      taken[left] = taken[left + 1] = true;
      const bool in_order = merged[left].of_first;
      pairs.emplace_back(merged[in_order ? left : left + 1].index,
                         merged[in_order ? left + 1 : left].index);
    }
  }
  std::ranges::sort(pairs);
  return pairs;
}

namespace {

/// In the complex plane least squares are scalar: to - mean = z (from - mean), z = S / spread.
struct PlanarMoments {
  std::complex<double> from_mean;
  std::complex<double> to_mean;
  std::complex<double> covariance;  ///< sum of to * conj(from), centred
  double from_spread = 0.0;         ///< sum of |from|^2, centred
  bool turn_known = false;  ///< false for single places and for covariances of rounding size
};

std::complex<double> mean(std::span<const Eigen::Vector2d> points) {
  std::complex<double> sum;
  for (const Eigen::Vector2d& point : points) {
    sum += detail::to_complex(point);
  }
  return sum / static_cast<double>(points.size());
}

PlanarMoments moments(std::span<const Eigen::Vector2d> from, std::span<const Eigen::Vector2d> to) {
  check(from.size() == to.size() && !from.empty(),
        "alignment needs equally many points, at least one");
  PlanarMoments m;
  m.from_mean = mean(from);
  m.to_mean = mean(to);
  double to_spread = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const std::complex<double> from_centred = detail::to_complex(from[i]) - m.from_mean;
    const std::complex<double> to_centred = detail::to_complex(to[i]) - m.to_mean;
    m.covariance += to_centred * std::conj(from_centred);
    m.from_spread += std::norm(from_centred);
    to_spread += std::norm(to_centred);
  }
  // A mean of n equal points is off by up to n roundings, and so is each centred point.
  const double count = static_cast<double>(from.size());
  const double rounding = 2.0 * count * std::numeric_limits<double>::epsilon();
  const bool from_has_extent = m.from_spread > count * std::norm(rounding * m.from_mean);
  const bool to_has_extent = to_spread > count * std::norm(rounding * m.to_mean);
  m.turn_known = from_has_extent && to_has_extent &&
                 std::abs(m.covariance) > rounding * std::sqrt(m.from_spread * to_spread);
  return m;
}

}  // namespace

Se2 align_se2(std::span<const Eigen::Vector2d> from, std::span<const Eigen::Vector2d> to) {
  const PlanarMoments m = moments(from, to);
  const double yaw_rad = m.turn_known ? std::arg(m.covariance) : 0.0;
  const std::complex<double> shift = m.to_mean - std::polar(1.0, yaw_rad) * m.from_mean;
  return Se2::from_xy_yaw(shift.real(), shift.imag(), yaw_rad);
}

std::optional<Sim2> align_sim2(std::span<const Eigen::Vector2d> from,
                               std::span<const Eigen::Vector2d> to) {
  const PlanarMoments m = moments(from, to);
  if (!m.turn_known) {
    return std::nullopt;
  }
  const std::complex<double> z = m.covariance / m.from_spread;
  const std::complex<double> shift = m.to_mean - z * m.from_mean;
  return Sim2::from_xy_yaw_scale(shift.real(), shift.imag(), std::arg(z), std::abs(z));
}

}  // namespace sketchloc
