#include "motion/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <queue>
#include <tuple>

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

/// All times of two lists in one order, linked, so that matched ones can be taken out. The closest
/// pair from different lists is always a pair of neighbours here.
class MergedTimes {
 public:
  MergedTimes(std::span<const double> first_s, std::span<const double> second_s) {
    for (std::size_t i = 0; i < first_s.size(); ++i) {
      nodes_.push_back({.time_s = first_s[i], .index = i, .of_first = true});
    }
    for (std::size_t i = 0; i < second_s.size(); ++i) {
      nodes_.push_back({.time_s = second_s[i], .index = i, .of_first = false});
    }
    std::ranges::stable_sort(nodes_, {}, &Node::time_s);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      nodes_[i].before = i == 0 ? kNone : i - 1;
      nodes_[i].after = i + 1 == nodes_.size() ? kNone : i + 1;
    }
  }

  /// Pairs each time with its nearest, closest pairs first.
  std::vector<std::pair<std::size_t, std::size_t>> take_pairs(double max_gap_s) {
    for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
      propose(i, i + 1, max_gap_s);
    }
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    while (!proposals_.empty()) {
      const auto [gap_s, left, right] = proposals_.top();
      proposals_.pop();
      if (nodes_[left].taken || nodes_[right].taken) {
        continue;
      }
      const bool in_order = nodes_[left].of_first;
      pairs.emplace_back(nodes_[in_order ? left : right].index,
                         nodes_[in_order ? right : left].index);
      take(left, right, max_gap_s);
    }
    std::ranges::sort(pairs);
    return pairs;
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  struct Node {
    double time_s = 0.0;
    std::size_t index = 0;
    bool of_first = false;
    bool taken = false;
    std::size_t before = kNone;
    std::size_t after = kNone;
  };
  using Proposal = std::tuple<double, std::size_t, std::size_t>;  // gap_s, left, right

  void propose(std::size_t left, std::size_t right, double max_gap_s) {
    const double gap_s = nodes_[right].time_s - nodes_[left].time_s;
    if (nodes_[left].of_first != nodes_[right].of_first && gap_s <= max_gap_s) {
      proposals_.emplace(gap_s, left, right);
    }
  }

  /// Takes two neighbours out; the ones outside become neighbours.
  void take(std::size_t left, std::size_t right, double max_gap_s) {
    nodes_[left].taken = nodes_[right].taken = true;
    const std::size_t before = nodes_[left].before;
    const std::size_t after = nodes_[right].after;
    if (before != kNone) {
      nodes_[before].after = after;
    }
    if (after != kNone) {
      nodes_[after].before = before;
    }
    if (before != kNone && after != kNone) {
      propose(before, after, max_gap_s);
    }
  }

  std::vector<Node> nodes_;
  std::priority_queue<Proposal, std::vector<Proposal>, std::greater<>> proposals_;
};

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> match_by_time(std::span<const double> first_s,
                                                               std::span<const double> second_s,
                                                               double max_gap_s) {
  check(std::ranges::is_sorted(first_s) && std::ranges::is_sorted(second_s),
        "times to match must not decrease");
  return MergedTimes(first_s, second_s).take_pairs(max_gap_s);
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
