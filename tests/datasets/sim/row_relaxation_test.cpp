#include "datasets/sim/detail/row_relaxation.hpp"

#include <gtest/gtest.h>

namespace sketchloc::detail {
namespace {

const AxisStretch::Lattice kLattice = {.axis = 0, .low = {0.0, 0.0}, .along = 0.5, .across = 0.5};
constexpr int kColumns = 21;  // 10 m
constexpr int kRows = 13;     // 6 m

StretchWishes even_wishes() {
  return {.rate = Grid<double>(kColumns, kRows, 1.0),
          .rate_weight = Grid<double>(kColumns, kRows, 1.0),
          .shear = Grid<double>(kColumns, kRows, 0.0),
          .shear_weight = Grid<double>(kColumns, kRows, 0.1)};
}

double width(const AxisStretch& stretch, double from, double to, double y) {
  return stretch.at({to, y}).value.x() - stretch.at({from, y}).value.x();
}

TEST(RelaxRows, LeavesAllAsItIsWhereNothingElseIsWanted) {
  const AxisStretch stretch = relax_rows(kLattice, even_wishes(), 0.1);
  EXPECT_TRUE(stretch.at({3.3, 2.2}).value.isApprox(Eigen::Vector2d(3.3, 2.2), 1e-6));
}

TEST(RelaxRows, GivesAWishThatNothingSpeaksAgainst) {
  StretchWishes wishes = even_wishes();
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      wishes.rate.at({column, row}) = column < 10 ? 2.0 : 1.0;
    }
  }
  const AxisStretch stretch = relax_rows(kLattice, wishes, 0.1);
  EXPECT_NEAR(width(stretch, 1.0, 4.0, 3.0), 6.0, 0.01);
  EXPECT_NEAR(width(stretch, 6.0, 9.0, 3.0), 3.0, 0.01);
}

/// The lower half wants to be wide on the left, the upper half on the right.
StretchWishes conflicting_wishes() {
  StretchWishes wishes = even_wishes();
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      wishes.rate.at({column, row}) = (column < kColumns / 2) == (row < kRows / 2) ? 2.0 : 0.6;
    }
  }
  return wishes;
}

double middle_shift(const AxisStretch& stretch) {
  return stretch.at({5.0, 1.0}).value.x() - stretch.at({5.0, 5.0}).value.x();
}

TEST(RelaxRows, ShearsRowsAgainstEachOtherWhereTheirWishesDiffer) {
  EXPECT_GT(middle_shift(relax_rows(kLattice, conflicting_wishes(), 0.1)), 2.0);
}

TEST(RelaxRows, KeepsALineOfHighShearWeightStraight) {
  StretchWishes wishes = conflicting_wishes();
  for (int row = 0; row < kRows; ++row) {
    wishes.shear_weight.at({10, row}) = 1e4;
  }
  EXPECT_NEAR(middle_shift(relax_rows(kLattice, wishes, 0.1)), 0.0, 0.15);  // 2 m without
}

TEST(RelaxRows, NeverGoesBelowTheLeastRate) {
  StretchWishes wishes = even_wishes();
  wishes.shear = Grid<double>(kColumns, kRows, 0.0);
  for (int row = 0; row < kRows; ++row) {  // columns that want to cross
    wishes.shear.at({10, row}) = 30.0;
    wishes.shear_weight.at({10, row}) = 1e4;
  }
  const AxisStretch stretch = relax_rows(kLattice, wishes, 0.1);
  for (double x = 0.0; x < 10.0; x += 0.1) {
    for (double y = 0.0; y < 6.0; y += 0.1) {
      EXPECT_GE(stretch.at({x, y}).jacobian(0, 0), 0.1 - 1e-9);
    }
  }
}

}  // namespace
}  // namespace sketchloc::detail
