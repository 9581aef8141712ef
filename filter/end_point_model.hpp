#pragma once

#include <span>
#include <vector>

#include "datasets/scan.hpp"
#include "datasets/sketch.hpp"
#include "filter/beam_selection.hpp"
#include "filter/end_point_kernel.hpp"
#include "filter/particle_set.hpp"
#include "filter/predict.hpp"

namespace sketchloc {

/// The end-point likelihood field, for maps in true proportions. On drawings it is the baseline
/// that fails: any shrunken scan fits dense strokes. See EndPointKernel.
struct EndPointModelParams {
  BeamSelection selection{.beams = 180, .max_range_m = 80.0};
  double sigma_m = 0.07;  ///< of the distance to the nearest face of a stroke, > 0
  double floor = 0.1;     ///< share of beams that say nothing, in (0, 1]
  double exponent = 0.2;  ///< tempers the beams of one scan, which are correlated, in (0, 1]
};

template <typename Visitor>
void visit_fields(EndPointModelParams& params, Visitor&& visit) {
  visit("selection", params.selection);
  visit("sigma_m", params.sigma_m);
  visit("floor", params.floor);
  visit("exponent", params.exponent);
}

void validate(const EndPointModelParams& params);

/// One scan at a time against many particles.
class EndPointModel {
 public:
  /// `px_per_m` turns sigma_m into pixels: the map's scale, or a guess for a drawing.
  EndPointModel(const Sketch& sketch, double px_per_m, const EndPointModelParams& params);

  /// Takes the end points of a scan; returns how many there are to score. Keeps its memory.
  std::size_t observe(const Scan& scan);

  /// Log-likelihood of the observed points, not tempered, for a range of particles: written to
  /// log_likelihood[i] for each i in the range. Safe to call from many threads.
  void score(const ParticleSet& particles, const ParticleRange& range,
             std::span<float> log_likelihood) const;

 private:
  EndPointModelParams params_;
  EndPointKernel kernel_;
  std::vector<SelectedBeam> selected_;
  std::vector<float> x_m_;
  std::vector<float> y_m_;
};

}  // namespace sketchloc
