#include "apps/track_tally.hpp"

#include <algorithm>
#include <cmath>

namespace sketchloc {
namespace {

constexpr double kBin_s = 1e-4;
constexpr std::size_t kBins = 100'000;

}  // namespace

void Durations::add(double seconds) {
  bins_.resize(kBins);
  const double bin = std::clamp(seconds / kBin_s, 0.0, static_cast<double>(kBins - 1));
  ++bins_[static_cast<std::size_t>(bin)];
  ++count_;
  sum_s_ += seconds;
  max_s_ = std::max(max_s_, seconds);
}

double Durations::mean_s() const { return count_ > 0 ? sum_s_ / static_cast<double>(count_) : 0.0; }

double Durations::quantile_s(double share) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
  std::uint64_t sum = 0;
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
    sum += bins_[bin];
    if (sum >= wanted && sum > 0) {
      return std::min((static_cast<double>(bin) + 0.5) * kBin_s, max_s_);
    }
  }
  return 0.0;
}

void TrackTally::add(const TrackedScan& scan) {
  if (scan.status == TrackedScan::Status::NotStarted) {
    ++not_started;
    return;
  }
  if (scan.status == TrackedScan::Status::Refused) {
    late += scan.refusal == Refusal::Late ? 1 : 0;
    return;
  }
  ++tracked;
  missed_deadlines += scan.missed_deadline ? 1 : 0;
  fewer_particles += scan.report.limited ? 1 : 0;
  registrations += scan.report.looked ? 1 : 0;
  held_back += scan.report.held_back ? 1 : 0;
  latency.add(scan.latency_s);
  odometry.add(scan.odometry_s);
  (scan.report.looked ? localizer_with_registration : localizer_without_registration)
      .add(scan.localizer_s);
}

}  // namespace sketchloc
