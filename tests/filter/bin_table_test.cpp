#include "filter/bin_table.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

namespace sketchloc {
namespace {

TEST(BinTable, SumsWeightsByBin) {
  BinTable table(4);
  EXPECT_EQ(table.add(7, 1.0), 1.0);
  EXPECT_EQ(table.add(9, 2.0), 2.0);
  EXPECT_EQ(table.add(7, 0.5), 1.5);
  EXPECT_EQ(table.size(), 2U);
}

TEST(BinTable, ForgetsEverythingWhenCleared) {
  BinTable table(4);
  table.add(7, 1.0);
  table.clear();
  EXPECT_EQ(table.size(), 0U);
  EXPECT_EQ(table.add(7, 0.25), 0.25);
}

TEST(BinTable, HoldsAsManyBinsAsItWasMadeFor) {
  BinTable table(1000);
  for (std::uint64_t bin = 0; bin < 1000; ++bin) {
    table.add(bin << 32, 1.0);
  }
  EXPECT_EQ(table.size(), 1000U);
}

TEST(PoseBin, TellsNeighboursAndSidesOfTheOriginApart) {
  std::set<std::uint64_t> bins;
  for (const double x : {-1.5, -0.5, 0.5, 1.5}) {
    for (const double y : {-0.5, 0.5}) {
      for (const double heading_rad : {-3.0, -1.0, 1.0, 3.0}) {
        bins.insert(pose_bin(x, y, heading_rad, 1.0, std::numbers::pi / 4.0));
      }
    }
  }
  EXPECT_EQ(bins.size(), 32U);
}

TEST(PoseBin, IsTheSameWithinACell) {
  EXPECT_EQ(pose_bin(10.1, 20.1, 0.1, 5.0, 0.5), pose_bin(14.9, 24.9, 0.3, 5.0, 0.5));
}

}  // namespace
}  // namespace sketchloc
