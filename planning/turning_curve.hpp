#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "planning/free_space.hpp"
#include "planning/path.hpp"

namespace sketchloc {

/// A place in the drawing and where the robot looks there: rad, in the sketch frame.
struct DrawnPose {
  Eigen::Vector2d place_in_sketch = Eigen::Vector2d::Zero();
  double heading_rad = 0.0;
};

/// Poses of a way that is driven forwards, a px or less apart, the first one included.
using TurningCurve = std::vector<DrawnPose>;

/// One arc, or a straight line where `curvature_per_px` is 0; left where it is positive.
TurningCurve arc_from(const DrawnPose& from, double way_px, double curvature_per_px);

/// The shortest curves between poses for a least turning radius [Dubins57], of OMPL.
class ShortestCurves {
 public:
  /// `radius_px` > 0.
  explicit ShortestCurves(double radius_px);
  ~ShortestCurves();

  double length_px(const DrawnPose& from, const DrawnPose& to) const;
  TurningCurve between(const DrawnPose& from, const DrawnPose& to) const;

 private:
  struct Curves;
  std::unique_ptr<Curves> curves_;
};

PathPoints places_of(const TurningCurve& curve);

/// As FreeSpace::cost_m, of a whole way.
double cost_m(const PathPoints& path_in_sketch, const FreeSpace& space);

}  // namespace sketchloc
