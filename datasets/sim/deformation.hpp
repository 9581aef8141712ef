#pragma once

#include <Eigen/Core>
#include <variant>
#include <vector>

#include "datasets/sim/axis_stretch.hpp"
#include "motion/se2.hpp"
#include "motion/sim2.hpp"
#include "registration/plane_map.hpp"
#include "registration/tps.hpp"

namespace sketchloc {

/// The affine map `linear * p + shift`.
struct AffineMap {
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();

  PlaneMapPoint at(const Eigen::Vector2d& point) const { return {linear * point + shift, linear}; }
};

/// The polar rotation and sqrt(det) of a Jacobian with det > 0: the similarity nearest to the map.
struct LocalSimilarity {
  double rotation_rad = 0.0;
  double scale = 1.0;       ///< sqrt(det J)
  double anisotropy = 1.0;  ///< ratio of the singular values, >= 1
};
LocalSimilarity local_similarity(const Eigen::Matrix2d& jacobian);

/// How a drawing distorts the world: a chain of smooth one-to-one maps, world (m) to sketch (px).
/// It is the ground truth of a drawing: it says where every place of the world was drawn.
class Deformation {
 public:
  using Step = std::variant<AffineMap, AxisStretch, ThinPlateSpline>;

  /// Appends a map after all others.
  void then(Step step) { steps_.push_back(std::move(step)); }

  Eigen::Vector2d operator()(const Eigen::Vector2d& point_in_world) const;
  PlaneMapPoint at(const Eigen::Vector2d& point_in_world) const;

  /// Where the robot is in the drawing: heading turned by the polar rotation of the local Jacobian,
  /// scale sqrt(det J).
  Sim2 sketch_from_robot(const Se2& world_from_robot) const;

 private:
  std::vector<Step> steps_;
};

/// The place of the world that was drawn at a point; Newton from the given guess.
Inversion invert(const Deformation& sketch_from_world, const Eigen::Vector2d& point_in_sketch,
                 const Eigen::Vector2d& guess_in_world);

}  // namespace sketchloc
