#include "apps/complaints.hpp"

#include <gtest/gtest.h>

namespace sketchloc {
namespace {

TEST(Complaints, SayEachKindOnceInAWhileAndHowOftenTheyDidNot) {
  Complaints complaints(5.0);
  EXPECT_EQ(complaints.about("late", "too late", 100.0), "too late");
  EXPECT_FALSE(complaints.about("late", "too late", 101.0));
  EXPECT_FALSE(complaints.about("late", "too late", 104.9));
  EXPECT_EQ(complaints.about("other", "something else", 102.0), "something else");
  EXPECT_EQ(complaints.about("late", "too late", 105.0), "too late (and 2 like it before)");
  EXPECT_EQ(complaints.about("late", "too late", 111.0), "too late");
}

}  // namespace
}  // namespace sketchloc
