#pragma once

#include <cstddef>

#include "motion/state_bytes.hpp"

namespace sketchloc {

/// Recovery of a lost robot: new particles come in where the evidence gets worse than it used to
/// be (augmented Monte Carlo localization [Thrun05 8.3]), from poses anywhere in the drawing that
/// fit the present scan (sensor resetting). For the filter alone: with registrations, challengers
/// do that, who have to prove themselves first.
struct RecoveryParams {
  double slow_way_m = 30.0;     ///< memory of the long-term evidence, in way driven, > 0
  double fast_way_m = 4.0;      ///< memory of the short-term evidence, > 0
  double evidence_beams = 6.0;  ///< independent beams in a scan, for the ratio of both, > 0
  double max_share = 2e-4;      ///< most of the particles replaced in one update, in [0, 0.5]
  double base_share = 1e-4;  ///< always replaced: the odds of having been carried away, in [0, 0.5]
  std::size_t candidates = 4000;     ///< poses tried for each injection, >= 1
  double candidate_exponent = 0.15;  ///< tempers the beams that choose among them, in (0, 1]
};

template <typename Visitor>
void visit_fields(RecoveryParams& params, Visitor&& visit) {
  visit("slow_way_m", params.slow_way_m);
  visit("fast_way_m", params.fast_way_m);
  visit("evidence_beams", params.evidence_beams);
  visit("max_share", params.max_share);
  visit("base_share", params.base_share);
  visit("candidates", params.candidates);
  visit("candidate_exponent", params.candidate_exponent);
}

void validate(const RecoveryParams& params);

/// Long- and short-term averages of the evidence per beam.
class EvidenceMonitor {
 public:
  explicit EvidenceMonitor(const RecoveryParams& params);

  /// Takes the mean log-likelihood per beam after driving a way.
  void add(double log_likelihood_per_beam, double way_m);

  /// The share of particles to replace, in [base_share, max_share].
  double injection_share() const;

  void save(StateWriter& state) const;
  void load(StateReader& state);

 private:
  RecoveryParams params_;
  bool started_ = false;
  double slow_ = 0.0;
  double fast_ = 0.0;
};

}  // namespace sketchloc
