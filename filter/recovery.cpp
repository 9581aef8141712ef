#include "filter/recovery.hpp"

#include <algorithm>
#include <cmath>

#include "motion/validate.hpp"

namespace sketchloc {

void validate(const RecoveryParams& params) {
  require_above("slow_way_m", params.slow_way_m, 0.0);
  require_above("fast_way_m", params.fast_way_m, 0.0);
  require_above("evidence_beams", params.evidence_beams, 0.0);
  require_in_range("max_share", params.max_share, 0.0, 0.5);
  require_in_range("base_share", params.base_share, 0.0, 0.5);
  require_in_range("candidates", static_cast<double>(params.candidates), 1.0, 1e6);
  require_in_range("candidate_exponent", params.candidate_exponent, 1e-6, 1.0);
}

EvidenceMonitor::EvidenceMonitor(const RecoveryParams& params) : params_(params) {}

void EvidenceMonitor::add(double log_likelihood_per_beam, double way_m) {
  if (!started_) {
    slow_ = fast_ = log_likelihood_per_beam;
    started_ = true;
    return;
  }
  slow_ += -std::expm1(-way_m / params_.slow_way_m) * (log_likelihood_per_beam - slow_);
  fast_ += -std::expm1(-way_m / params_.fast_way_m) * (log_likelihood_per_beam - fast_);
}

double EvidenceMonitor::injection_share() const {
  const double worse = -std::expm1(params_.evidence_beams * (fast_ - slow_));
  return std::clamp(worse, params_.base_share, std::max(params_.base_share, params_.max_share));
}

void EvidenceMonitor::save(StateWriter& state) const {
  state.put(started_);
  state.put(slow_);
  state.put(fast_);
}

void EvidenceMonitor::load(StateReader& state) {
  started_ = state.get<bool>();
  slow_ = state.get_finite();
  fast_ = state.get_finite();
}

}  // namespace sketchloc
