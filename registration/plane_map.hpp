#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>

namespace sketchloc {

/// A smooth map of the plane at one point.
struct PlaneMapPoint {
  Eigen::Vector2d value;
  Eigen::Matrix2d jacobian;  ///< column k is the derivative along input axis k
};

/// Any smooth map of the plane with its derivative.
using PlaneMap = std::function<PlaneMapPoint(const Eigen::Vector2d&)>;

/// An axis-aligned rectangle, sides included.
struct PlaneBox {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  Eigen::Vector2d high = Eigen::Vector2d::Zero();

  Eigen::Vector2d size() const { return high - low; }
  Eigen::Vector2d centre() const { return 0.5 * (low + high); }
  bool contains(const Eigen::Vector2d& point) const {
    return (point.array() >= low.array()).all() && (point.array() <= high.array()).all();
  }
  /// The same box with a margin on all sides.
  PlaneBox grown(double margin) const {
    return {low - Eigen::Vector2d::Constant(margin), high + Eigen::Vector2d::Constant(margin)};
  }
};

struct InversionParams {
  double tolerance = 1e-9;  ///< accepted distance from the target, in the map's output unit, > 0
  int max_iterations = 50;  ///< Newton steps per start, >= 1
};

/// Result of looking for the point that a map takes to a target.
struct Inversion {
  enum class Status {
    Converged,
    Singular,       ///< every start ran into a fold (det J = 0)
    IterationLimit  ///< no start came within the tolerance
  };
  Status status = Status::IterationLimit;
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< best point seen, whatever the status
  double error = 0.0;                               ///< distance of its image from the target
};

/// Newton's method with backtracking from each start in turn, until one converges; needs at least
/// one start.
Inversion invert(const PlaneMap& map, const Eigen::Vector2d& target,
                 std::span<const Eigen::Vector2d> starts, const InversionParams& params = {});

/// Where a map may fold over: the smallest det J on a lattice that covers a box.
struct FoldReport {
  double min_determinant = 0.0;
  Eigen::Vector2d worst_point = Eigen::Vector2d::Zero();
  bool folds() const { return !(min_determinant > 0.0); }  ///< also true for NaN
};

/// Looks at samples_per_side^2 points (at least 2 per side), the corners included.
FoldReport find_folds(const PlaneMap& map, const PlaneBox& box, int samples_per_side);

}  // namespace sketchloc
