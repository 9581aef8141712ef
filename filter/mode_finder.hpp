#pragma once

#include <cstdint>
#include <vector>

#include "filter/bin_table.hpp"
#include "filter/estimate.hpp"
#include "filter/particle_set.hpp"

namespace sketchloc {

struct ModeParams {
  double radius_m = 3.0;     ///< particles of one mode lie this near to its mean, > 0
  double radius_rad = 0.8;   ///< and head this alike, in (0, pi]
  int max_modes = 4;         ///< in [1, 16]
  double min_weight = 0.05;  ///< lighter modes are not reported, in [0, 1]
};

template <typename Visitor>
void visit_fields(ModeParams& params, Visitor&& visit) {
  visit("radius_m", params.radius_m);
  visit("radius_rad", params.radius_rad);
  visit("max_modes", params.max_modes);
  visit("min_weight", params.min_weight);
}

void validate(const ModeParams& params);

/// Finds the clusters of a particle set: the heaviest cell of a pose grid, moved to the mean of its
/// surroundings by mean shift, then the same without the particles it explains. The estimate is
/// the mean of the densest place, not of everything: hypotheses in two rooms never average to the
/// wall between them.
class ModeFinder {
 public:
  ModeFinder(const ModeParams& params, std::size_t max_particles);

  /// Refills `estimate`; particles need normalised weights (see normalise). Keeps its memory.
  void find(const ParticleSet& particles, Estimate& estimate);

 private:
  struct Seed {
    double x = 0.0;
    double y = 0.0;
    double heading_rad = 0.0;
    double weight = 0.0;
  };
  Seed heaviest_cell(const ParticleSet& particles, double radius_px);
  Mode mean_shift(const ParticleSet& particles, const Seed& seed, double radius_px) const;
  void claim(const ParticleSet& particles, const Mode& mode, double radius_px);

  ModeParams params_;
  BinTable cells_;
  std::vector<float> weight_;  ///< normalised to sum one; zero once claimed by a mode
};

}  // namespace sketchloc
