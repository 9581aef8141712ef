#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>
#include <vector>

#include "datasets/scan.hpp"
#include "datasets/sketch.hpp"
#include "filter/beam_model.hpp"
#include "filter/end_point_model.hpp"
#include "filter/localizer_params.hpp"
#include "filter/particle_set.hpp"
#include "registration/range_table.hpp"
#include "registration/warp_predictor.hpp"

namespace sketchloc {

/// Registrations, and for each particle the index of its own, or kNoLikelihood.
struct RegisteredParticles {
  std::span<const Registration> registrations;
  std::span<const std::int8_t> of_particle;
};

/// What weighs the particles by a scan: the measurement model that was chosen.
class ScanModel {
 public:
  /// The table must outlive the model.
  ScanModel(const Sketch& sketch, const RangeTable& table, const LocalizerParams& params);

  /// What tempers the log-likelihood of a whole scan.
  double exponent() const { return exponent_; }

  /// Takes a scan; returns how many of its beams there are to score.
  std::size_t observe(const Scan& scan);

  /// Log-likelihood of the observed scan, not tempered, for each particle, into the first scores.
  void score(const ParticleSet& particles, std::span<float> scores) const;

  /// Turns such scores into those of a mixture: the scan as it is, and as its particle's
  /// registration unbends it, by how probable it is that the warp is right; a wrong one costs
  /// little. `exponent` tempers both. End points are not unbent.
  void mix_unbent(const ParticleSet& particles, const RegisteredParticles& registered,
                  double exponent, std::span<float> scores);

 private:
  std::variant<BeamModel, EndPointModel> model_;
  double exponent_;
  int jobs_;
  std::vector<float> unbent_scores_;
};

}  // namespace sketchloc
