#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "filter/detail/beam_score.hpp"
#include "filter/particle_spans.hpp"
#include "registration/range_table.hpp"

namespace sketchloc {

/// One beam of a scan as every particle sees it.
struct Beam {
  float bearing_rad = 0.0F;  ///< in the robot frame
  float range_m = 0.0F;      ///< measured, > 0; without a return the sensor's largest range
  bool returned = true;
  float log_stretch = 0.0F;  ///< log of the drawing's extra stretch along this beam (from a warp)
};

/// The range-ratio model: K(d) = log((1 - floor) exp(-d^2 / (2 sigma^2)) + floor) of the log-ratio
/// d = log(measured / expected), and for beams without return, which only say that the expected
/// range is not below the sensor's, K(d) = log((1 - floor) Phi(-d / sigma) + floor).
struct BeamKernelParams {
  double sigma = 0.3;            ///< of the log-ratio, > 0; real drawings, DESIGN 10
  double floor = 0.3;            ///< share of beams that say nothing, in (0, 1]
  double no_return_floor = 0.3;  ///< the same for beams without return, in (0, 1]
  /// Log-likelihood of a beam that returned where the drawing has no stroke in reach; without it
  /// such a beam has its K at the farthest range of the table, mostly the log of `floor`.
  std::optional<double> nothing_drawn = {};
};

template <typename Visitor>
void visit_fields(BeamKernelParams& params, Visitor&& visit) {
  visit("sigma", params.sigma);
  visit("floor", params.floor);
  visit("no_return_floor", params.no_return_floor);
  visit("nothing_drawn", params.nothing_drawn);
}

void validate(const BeamKernelParams& params);

/// The beams of a scan in the integers of the kernel. Keeps its memory when it is filled again.
class PreparedBeams {
 public:
  std::size_t size() const { return beams_; }

 private:
  friend class BeamKernel;
  std::size_t beams_ = 0;
  std::vector<detail::BeamGroup> groups_;
};

/// Scores many particles against the beams of one scan with expected ranges from a RangeTable.
///
/// For a particle and a beam: the beam's direction u and length z through the particle's local map
/// J give a direction J u and z |J u| px in the drawing; d = log(z |J u|) - log(expected range at
/// the particle's cell in the nearest of 128 headings), and the score is the sum of K(d) over the
/// beams. All in integers: d is rounded to the table's `log_step` (the table's own rounding comes
/// on top), K to 1/65535 of its range. So scores are the same bits on every processor, and the sum
/// has no order. Strains are rounded to 1/64 and count up to 1.5.
class BeamKernel {
 public:
  /// Natural logarithm of a likelihood (up to a constant) given d; read between -64 and 63 steps,
  /// which covers +-1.9 with the usual step of 0.03; beyond, its values there hold.
  using LogKernel = std::function<double(double log_ratio)>;

  /// The table must outlive the kernel.
  BeamKernel(const RangeTable& table, const BeamKernelParams& params);
  BeamKernel(const RangeTable& table, const LogKernel& returned, const LogKernel& not_returned,
             std::optional<double> nothing_drawn = std::nullopt);
  BeamKernel(RangeTable&&, const BeamKernelParams&) = delete;

  /// Fills `prepared` from a scan; allocates only to grow.
  void prepare(std::span<const Beam> beams, PreparedBeams& prepared) const;

  /// Log-likelihood of every particle, untempered. A particle outside the drawing (or one whose
  /// scale or strain is not finite) gets the least score there is. Safe to call from many threads.
  void score(const ParticleSpans& particles, const PreparedBeams& beams,
             std::span<float> log_likelihood) const;

 private:
  const RangeTable* table_;
  detail::KernelTables kernels_;
  std::vector<detail::StrainLevel> strain_;
  double least_;  ///< of both kernels: what the integer 0 stands for
  double unit_;   ///< of the integers of both kernels
};

}  // namespace sketchloc
