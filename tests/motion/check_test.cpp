#include "motion/check.hpp"

#include <gtest/gtest.h>

namespace sketchloc {
namespace {

TEST(Check, PassesWhereTheContractHolds) { check(true, "never seen"); }

TEST(CheckDeathTest, NamesFileLineAndContractInEveryBuildType) {
  EXPECT_DEATH(check(false, "two is not one"), "check_test.cpp:[0-9]+: .*two is not one");
}

}  // namespace
}  // namespace sketchloc
