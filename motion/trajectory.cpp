#include "motion/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

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

std::vector<std::pair<std::size_t, std::size_t>> match_by_time(std::span<const double> first_s,
                                                               std::span<const double> second_s,
                                                               double max_gap_s) {
  struct Candidate {
    double gap_s;
    std::size_t first;
    std::size_t second;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < first_s.size(); ++i) {
    const auto low = std::ranges::lower_bound(second_s, first_s[i] - max_gap_s);
    for (auto it = low; it != second_s.end() && *it <= first_s[i] + max_gap_s; ++it) {
      candidates.push_back(
          {std::abs(*it - first_s[i]), i, static_cast<std::size_t>(it - second_s.begin())});
    }
  }
  std::ranges::stable_sort(candidates, {}, &Candidate::gap_s);
  std::vector<bool> first_used(first_s.size());
  std::vector<bool> second_used(second_s.size());
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const Candidate& c : candidates) {
    if (!first_used[c.first] && !second_used[c.second]) {
      first_used[c.first] = second_used[c.second] = true;
      pairs.emplace_back(c.first, c.second);
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
};

PlanarMoments moments(std::span<const Eigen::Vector2d> from, std::span<const Eigen::Vector2d> to) {
  check(from.size() == to.size() && !from.empty(),
        "alignment needs equally many points, at least one");
  PlanarMoments m;
  const double count = static_cast<double>(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) {
    m.from_mean += detail::to_complex(from[i]) / count;
    m.to_mean += detail::to_complex(to[i]) / count;
  }
  for (std::size_t i = 0; i < from.size(); ++i) {
    const std::complex<double> centred = detail::to_complex(from[i]) - m.from_mean;
    m.covariance += (detail::to_complex(to[i]) - m.to_mean) * std::conj(centred);
    m.from_spread += std::norm(centred);
  }
  return m;
}

}  // namespace

Se2 align_se2(std::span<const Eigen::Vector2d> from, std::span<const Eigen::Vector2d> to) {
  const PlanarMoments m = moments(from, to);
  const double yaw_rad = m.covariance == 0.0 ? 0.0 : std::arg(m.covariance);
  const std::complex<double> shift = m.to_mean - std::polar(1.0, yaw_rad) * m.from_mean;
  return Se2::from_xy_yaw(shift.real(), shift.imag(), yaw_rad);
}

std::optional<Sim2> align_sim2(std::span<const Eigen::Vector2d> from,
                               std::span<const Eigen::Vector2d> to) {
  const PlanarMoments m = moments(from, to);
  if (m.from_spread <= 0.0 || m.covariance == 0.0) {
    return std::nullopt;
  }
  const std::complex<double> z = m.covariance / m.from_spread;
  const std::complex<double> shift = m.to_mean - z * m.from_mean;
  return Sim2::from_xy_yaw_scale(shift.real(), shift.imag(), std::arg(z), std::abs(z));
}

}  // namespace sketchloc
