#pragma once

#include <span>
#include <vector>

#include "filter/beam_set.hpp"
#include "filter/particle_set.hpp"
#include "filter/predict.hpp"
#include "registration/range_table.hpp"

namespace sketchloc {

/// The range-ratio beam model for drawings. A beam of z metres along a particle's local map J is
/// z |J u| pixels long where the drawing has e pixels to the first stroke; scored is log of the
/// ratio, a Gaussian with a heavy floor: what people draw right is what comes next in a direction,
/// what they draw wrong is how far.
struct BeamModelParams {
  BeamSelection selection;
  double sigma_log = 0.3;       ///< of the log ratio, > 0
  double floor = 0.3;           ///< likelihood of any beam against a perfect one, in (0, 1)
  double exponent = 0.05;       ///< tempers the beams of one scan, which are correlated, in (0, 1]
  double exponent_way_m = 0.0;  ///< way after which a scan counts fully; less way counts less, >= 0
};
void validate(const BeamModelParams& params);

class BeamModel {
 public:
  BeamModel(const RangeTable& table, const BeamModelParams& params);

  /// Log-likelihood, not tempered, of the beams for a range of particles, written to
  /// log_likelihood[i] for i in the range.
  void score(const ParticleSet& particles, const ParticleRange& range, const BeamSet& beams,
             std::span<float> log_likelihood) const;

  const BeamModelParams& params() const { return params_; }

 private:
  const RangeTable* table_;
  BeamModelParams params_;
  std::vector<float> log_kernel_;  ///< over code differences, -255..255
};

}  // namespace sketchloc
