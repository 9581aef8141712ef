#pragma once

#include <Eigen/Core>
#include <span>

#include "datasets/grid.hpp"

namespace sketchloc {

/// What a localized robot knows of the drawing at a place.
struct ScaleSample {
  Eigen::Vector2d place_in_sketch = Eigen::Vector2d::Zero();
  double px_per_m = 1.0;  ///< > 0
};

struct ScaleFieldParams {
  double reach_px = 60.0;     ///< how far a sample tells of its surroundings, 1-sigma, > 0
  double mean_weight = 0.05;  ///< of the mean of all samples against one sample at hand, > 0
};

template <typename Visitor>
void visit_fields(ScaleFieldParams& params, Visitor&& visit) {
  visit("reach_px", params.reach_px);
  visit("mean_weight", params.mean_weight);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const ScaleFieldParams& params);

/// How many px a metre has at every place of a drawing: its deformation without direction. It turns
/// lengths in the drawing into real ones.
class ScaleField {
 public:
  /// The same everywhere.
  explicit ScaleField(double px_per_m);

  /// Near samples the scale that they tell, elsewhere their mean: averages of log scales, weighted
  /// by a Gaussian of the distance. Needs at least one sample.
  ScaleField(int width_px, int height_px, std::span<const ScaleSample> samples,
             const ScaleFieldParams& params = {});

  double px_per_m(const Eigen::Vector2d& place_in_sketch) const;

  /// 1 / px_per_m in the middle of every px of a drawing, several times as quick as one by one.
  Grid<float> m_per_px(int width_px, int height_px) const;

 private:
  double elsewhere_px_per_m_;
  Grid<float> log_px_per_m_;  ///< at coarse cells; empty: the same everywhere
};

}  // namespace sketchloc
