#pragma once

#include <span>
#include <vector>

#include "filter/beam_kernel.hpp"
#include "filter/beam_selection.hpp"
#include "filter/particle_set.hpp"
#include "filter/predict.hpp"
#include "registration/range_table.hpp"

namespace sketchloc {

/// The measurement model for drawings: what people draw right is what comes next in a direction,
/// what they draw wrong is how far. See BeamKernel.
struct BeamModelParams {
  BeamSelection selection;
  BeamKernelParams kernel;
  double exponent = 0.05;  ///< tempers the beams of one scan, which are correlated, in (0, 1]
};

template <typename Visitor>
void visit_fields(BeamModelParams& params, Visitor&& visit) {
  visit("selection", params.selection);
  visit("kernel", params.kernel);
  visit("exponent", params.exponent);
}

void validate(const BeamModelParams& params);

/// One scan at a time against many particles.
class BeamModel {
 public:
  /// The table must outlive the model.
  BeamModel(const RangeTable& table, const BeamModelParams& params);

  /// Takes the beams of a scan; returns how many there are to score. Keeps its memory.
  std::size_t observe(const Scan& scan);

  /// Log-likelihood of the observed beams, not tempered, for a range of particles: written to
  /// log_likelihood[i] for each i in the range. Safe to call from many threads.
  void score(const ParticleSet& particles, const ParticleRange& range,
             std::span<float> log_likelihood) const;

 private:
  BeamModelParams params_;
  BeamKernel kernel_;
  std::vector<SelectedBeam> selected_;
  std::vector<Beam> beams_;
  PreparedBeams prepared_;
};

}  // namespace sketchloc
