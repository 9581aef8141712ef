#include "registration/train/deformation_table.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "motion/check.hpp"

namespace sketchloc {

DeformationTable::DeformationTable(Deformation sketch_from_world, const PlaneBox& box_in_world,
                                   double spacing_m)
    : sketch_from_world_(std::move(sketch_from_world)),
      origin_in_world_(box_in_world.low),
      spacing_m_(spacing_m) {
  check(spacing_m > 0.0, "lattice points lie apart");
  const Eigen::Vector2d steps = (box_in_world.size() / spacing_m).array().ceil();
  values_ = Grid<Eigen::Vector2f>(static_cast<int>(steps.x()) + 1, static_cast<int>(steps.y()) + 1,
                                  Eigen::Vector2f::Zero());
  for (int row = 0; row < values_.height(); ++row) {
    for (int column = 0; column < values_.width(); ++column) {
      const Eigen::Vector2d point = origin_in_world_ + spacing_m_ * Eigen::Vector2d(column, row);
      values_.at({column, row}) = sketch_from_world_(point).cast<float>();
    }
  }
}

Eigen::Vector2d DeformationTable::operator()(const Eigen::Vector2d& point_in_world) const {
  const Eigen::Vector2d place = (point_in_world - origin_in_world_) / spacing_m_;
  const Cell low = cell_at(place);
  if (!values_.contains(low) || !values_.contains({low.column + 1, low.row + 1})) {
    return sketch_from_world_(point_in_world);
  }
  const double u = place.x() - low.column;
  const double v = place.y() - low.row;
  const auto at = [&](int column, int row) -> Eigen::Vector2d {
    return values_.row(low.row + row)[static_cast<std::size_t>(low.column + column)].cast<double>();
  };
  return (1.0 - v) * ((1.0 - u) * at(0, 0) + u * at(1, 0)) +
         v * ((1.0 - u) * at(0, 1) + u * at(1, 1));
}

Inversion DeformationTable::inverse(const Eigen::Vector2d& point_in_sketch,
                                    const Eigen::Vector2d& guess_in_world) const {
  const double half_m = 0.5 * spacing_m_;
  const PlaneMap map = [&](const Eigen::Vector2d& point) {
    Eigen::Matrix2d jacobian;
    for (int axis = 0; axis < 2; ++axis) {
      const Eigen::Vector2d step = half_m * Eigen::Vector2d::Unit(axis);
      jacobian.col(axis) = ((*this)(point + step) - (*this)(point - step)) / spacing_m_;
    }
    return PlaneMapPoint{.value = (*this)(point), .jacobian = jacobian};
  };
  const std::array<Eigen::Vector2d, 1> starts = {guess_in_world};
  return invert(map, point_in_sketch, starts, {.tolerance = 0.02, .max_iterations = 40});
}

}  // namespace sketchloc
