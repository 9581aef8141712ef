#include "datasets/sim/detail/row_relaxation.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>

#include "motion/check.hpp"

namespace sketchloc::detail {
namespace {

/// Ties every node weakly to where it is, so that the system has one solution.
constexpr double kAnchorWeight = 1e-6;

/// Normal equations of sum weight * (x_to - x_from - wanted)^2.
class DifferenceSystem {
 public:
  explicit DifferenceSystem(int unknowns)
      : unknowns_(unknowns), right_side_(Eigen::VectorXd::Zero(unknowns)) {}

  void want_value(int node, double value, double weight) {
    entries_.emplace_back(node, node, weight);
    right_side_(node) += weight * value;
  }
  void want_difference(int from, int to, double wanted, double weight) {
    entries_.emplace_back(from, from, weight);
    entries_.emplace_back(to, to, weight);
    entries_.emplace_back(from, to, -weight);
    entries_.emplace_back(to, from, -weight);
    right_side_(from) -= weight * wanted;
    right_side_(to) += weight * wanted;
  }
  Eigen::VectorXd solve() const {
    Eigen::SparseMatrix<double> system(unknowns_, unknowns_);
    system.setFromTriplets(entries_.begin(), entries_.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factored(system);
    check(factored.info() == Eigen::Success, "weights are positive");
    return factored.solve(right_side_);
  }

 private:
  int unknowns_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::VectorXd right_side_;
};

Grid<double> wished_positions(const AxisStretch::Lattice& lattice, const StretchWishes& wishes) {
  const int columns = wishes.rate.width();
  const int rows = wishes.rate.height();
  const double ratio = lattice.along / lattice.across;
  DifferenceSystem system(columns * rows);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int node = row * columns + column;
      system.want_value(node, lattice.low.x() + lattice.along * column, kAnchorWeight);
      if (column + 1 < columns) {  // (du' / along - rate)^2 over a cell of along * across
        const double wanted =
            0.5 * (wishes.rate.at({column, row}) + wishes.rate.at({column + 1, row}));
        system.want_difference(node, node + 1, lattice.along * wanted,
                               wishes.rate_weight.at({column, row}) / ratio);
      }
      if (row + 1 < rows) {
        system.want_difference(node, node + columns,
                               lattice.across * wishes.shear.at({column, row}),
                               wishes.shear_weight.at({column, row}) * ratio);
      }
    }
  }
  const Eigen::VectorXd solution = system.solve();
  Grid<double> positions(columns, rows);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      positions.at({column, row}) = solution(row * columns + column);
    }
  }
  return positions;
}

}  // namespace

AxisStretch relax_rows(const AxisStretch::Lattice& lattice, const StretchWishes& wishes,
                       double min_rate) {
  const Grid<double> positions = wished_positions(lattice, wishes);
  const int last = positions.width() - 1;
  Grid<double> rates(positions.width(), positions.height());
  std::vector<double> starts;
  for (int row = 0; row < rates.height(); ++row) {
    for (int column = 0; column <= last; ++column) {
      const int before = std::max(column - 1, 0);
      const int after = std::min(column + 1, last);
      const double rise = positions.at({after, row}) - positions.at({before, row});
      rates.at({column, row}) = std::max(min_rate, rise / (lattice.along * (after - before)));
    }
    starts.push_back(positions.at({0, row}));
  }
  return {lattice, std::move(rates), std::move(starts)};
}

}  // namespace sketchloc::detail
