#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "datasets/grid.hpp"
#include "filter/particle_spans.hpp"

namespace sketchloc {

/// The end-point model: log((1 - floor) exp(-d^2 / (2 sigma^2)) + floor) at the distance d between
/// the end of a beam and the nearest stroke [Thrun05 6.4]. Good on metric maps; on drawings it is
/// the baseline that fails, since any shrunken scan fits a dense drawing.
struct EndPointParams {
  double sigma_px = 2.0;  ///< > 0
  double floor = 0.1;     ///< share of beams that say nothing, in (0, 1]
};
void validate(const EndPointParams& params);

/// The model at every cell of a distance field (px); infinity gives the log of `floor`.
Grid<float> likelihood_field(const Grid<float>& distance_px, const EndPointParams& params);

/// Ends of the beams of one scan in the robot frame, m.
struct EndPoints {
  std::span<const float> x_m;
  std::span<const float> y_m;

  std::size_t size() const { return x_m.size(); }
};

/// Scores many particles against the end points of one scan: each point goes through the particle's
/// local map into the sketch and reads the log-likelihood of the cell there; the score is the sum.
///
/// The field is kept in 16 bits (1/65535 of its range). Coordinates are float: a point that falls
/// within 1e-3 px of a cell's side may read the neighbour. The same bits on every processor.
class EndPointKernel {
 public:
  /// `outside`: log-likelihood of points outside the field. All values must be finite.
  EndPointKernel(const Grid<float>& log_likelihood, double outside);

  /// Log-likelihood of every particle, untempered; a particle that is not finite has all its points
  /// outside. Safe to call from many threads.
  void score(const ParticleSpans& particles, const EndPoints& points,
             std::span<float> log_likelihood) const;

 private:
  int width_ = 0;  ///< of the field without its border
  int height_ = 0;
  double least_ = 0.0;                ///< what the integer 0 stands for
  double unit_ = 0.0;                 ///< of the integers
  std::vector<std::uint16_t> field_;  ///< with a border of one column and row
};

}  // namespace sketchloc
