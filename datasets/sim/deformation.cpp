#include "datasets/sim/deformation.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "motion/angles.hpp"

namespace sketchloc {

LocalSimilarity local_similarity(const Eigen::Matrix2d& jacobian) {
  // J = R S with R a rotation: its similar part is (a, b), the rest mirrors.
  const double a = 0.5 * (jacobian(0, 0) + jacobian(1, 1));
  const double b = 0.5 * (jacobian(1, 0) - jacobian(0, 1));
  const double c = 0.5 * (jacobian(0, 0) - jacobian(1, 1));
  const double d = 0.5 * (jacobian(1, 0) + jacobian(0, 1));
  const double similar = std::hypot(a, b);   // half the sum of the singular values
  const double mirrored = std::hypot(c, d);  // half their difference
  return {.rotation_rad = std::atan2(b, a),
          .scale = std::sqrt(jacobian.determinant()),
          .anisotropy = (similar + mirrored) / (similar - mirrored)};
}

PlaneMapPoint Deformation::at(const Eigen::Vector2d& point_in_world) const {
  PlaneMapPoint total{.value = point_in_world, .jacobian = Eigen::Matrix2d::Identity()};
  for (const Step& step : steps_) {
    const PlaneMapPoint here =
        std::visit([&](const auto& map) { return map.at(total.value); }, step);
    total.value = here.value;
    total.jacobian = here.jacobian * total.jacobian;
  }
  return total;
}

Eigen::Vector2d Deformation::operator()(const Eigen::Vector2d& point_in_world) const {
  return at(point_in_world).value;
}

Sim2 Deformation::sketch_from_robot(const Se2& world_from_robot) const {
  const PlaneMapPoint here = at(world_from_robot.translation());
  const LocalSimilarity local = local_similarity(here.jacobian);
  return Sim2::from_xy_yaw_scale(here.value.x(), here.value.y(),
                                 wrap_rad(world_from_robot.yaw_rad() + local.rotation_rad),
                                 local.scale);
}

Inversion invert(const Deformation& sketch_from_world, const Eigen::Vector2d& point_in_sketch,
                 const Eigen::Vector2d& guess_in_world) {
  const std::array<Eigen::Vector2d, 1> starts = {guess_in_world};
  return invert([&](const Eigen::Vector2d& point) { return sketch_from_world.at(point); },
                point_in_sketch, starts, {.tolerance = 1e-7, .max_iterations = 200});
}

}  // namespace sketchloc
