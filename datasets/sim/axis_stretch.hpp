#pragma once

#include <Eigen/Core>
#include <vector>

#include "datasets/grid.hpp"
#include "registration/plane_map.hpp"

namespace sketchloc {

/// A map of the plane that moves points along one axis only: it stretches every stretch of every
/// row by its own rate, and blends the rows smoothly. Because all rates are positive it is one to
/// one and never folds, however strong it is; it is continuously differentiable.
///
/// With u along the axis and v across it: u' = sum_j B_j(v) P_j(u), where P_j is the integral of
/// row j's rate (linear between nodes, constant beyond) and B_j are quadratic B-splines. det J =
/// sum_j B_j rate_j > 0.
class AxisStretch {
 public:
  struct Lattice {
    int axis = 0;                                   ///< 0: moves x, rows along y; 1: moves y
    Eigen::Vector2d low = Eigen::Vector2d::Zero();  ///< (u, v) of node (0, 0)
    double along = 0.5;                             ///< node spacing along u, > 0
    double across = 1.0;                            ///< row spacing along v, > 0
  };

  /// rates(column, row) > 0, at least 2 columns and 1 row; row j starts at u' = starts[j].
  AxisStretch(const Lattice& lattice, Grid<double> rates, std::vector<double> starts);

  PlaneMapPoint at(const Eigen::Vector2d& point) const;

  /// The point that goes to an image; exact, exists everywhere.
  Eigen::Vector2d inverse(const Eigen::Vector2d& image) const;

 private:
  struct Moved {
    double position;  ///< u'
    double rate;      ///< du'/du
    double shear;     ///< du'/dv
  };
  struct OnRow {
    double position;
    double rate;
  };
  OnRow on_row(int row, double u) const;
  Moved moved(double u, double v) const;

  Lattice lattice_;
  Grid<double> rates_;
  Grid<double> positions_;  ///< u' of every node
};

}  // namespace sketchloc
