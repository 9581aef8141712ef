#pragma once

#include <Eigen/Core>
#include <vector>

#include "datasets/sketch.hpp"
#include "filter/particle_set.hpp"
#include "filter/predict.hpp"
#include "motion/random.hpp"
#include "registration/range_table.hpp"

namespace sketchloc {

/// What is known of a drawing's mean scale before the robot has moved in it.
struct ScalePrior {
  double log_px_per_m = 3.0;
  double sigma = 0.3;  ///< of the log, >= 0
};

/// Where a robot can be in a drawing, with nothing known but the drawing.
class GlobalSampler {
 public:
  /// Free places are the table's cells off the strokes from which nearly all directions end at a
  /// stroke: outside of the building one looks past it.
  GlobalSampler(const Sketch& sketch, const RangeTable& table);

  bool empty() const { return free_cells_.empty(); }

  /// Median over the free places of the log of the radius (px) of a circle as large as what can be
  /// seen from there.
  double median_log_visible_radius() const { return median_log_visible_radius_; }

  /// Draws poses for a range of particles: place uniform in free space, any heading, scale from
  /// the prior, strain as people draw. Weights become one.
  void draw(ParticleSet& particles, const ParticleRange& range, const ScalePrior& scale,
            double strain_sigma, Rng& rng) const;

 private:
  std::vector<Cell> free_cells_;
  int cell_px_ = 1;
  double median_log_visible_radius_ = 0.0;
};

}  // namespace sketchloc
