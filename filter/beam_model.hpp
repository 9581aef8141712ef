#pragma once

#include <optional>
#include <span>
#include <vector>

#include "filter/beam_kernel.hpp"
#include "filter/beam_selection.hpp"
#include "filter/particle_set.hpp"
#include "filter/predict.hpp"
#include "registration/range_table.hpp"
#include "registration/warp_predictor.hpp"

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

  /// The observed beams as a registration unbends them: with its warp W and the warp's Jacobian J
  /// at the robot, end point b becomes J^-1 (W(b) - W(0)); beyond the registration's window, where
  /// the warp guesses, it stays. What is left of the drawing's deformation is linear, as in the
  /// particles. None where the warp folds at the robot.
  std::optional<PreparedBeams> unbent(const Registration& registration) const;

  /// The same as `score` for such beams.
  void score(const ParticleSet& particles, const ParticleRange& range, const PreparedBeams& beams,
             std::span<float> log_likelihood) const;

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
