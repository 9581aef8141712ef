#include "filter/online/stamps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace sketchloc {
namespace {

using ::testing::ElementsAre;

std::vector<Stamp> verdicts(const std::vector<double>& times_s) {
  StampMonitor monitor({.longest_gap_s = 1.0, .clock_jump_s = 1.0, .agreement = 3});
  std::vector<Stamp> found;
  for (const double time_s : times_s) {
    found.push_back(monitor.take(time_s));
  }
  return found;
}

TEST(Stamps, FollowEachOther) {
  EXPECT_THAT(verdicts({5.0, 5.1, 6.1}), ElementsAre(Stamp::Next, Stamp::Next, Stamp::Next));
}

TEST(Stamps, TellDuplicatesAndWhatCameTooLate) {
  EXPECT_THAT(verdicts({5.0, 5.0, 4.9, 5.1}),
              ElementsAre(Stamp::Next, Stamp::Duplicate, Stamp::OutOfOrder, Stamp::Next));
}

TEST(Stamps, GoAheadAfterAGap) {
  EXPECT_THAT(verdicts({5.0, 6.5, 6.6}), ElementsAre(Stamp::Next, Stamp::Ahead, Stamp::Next));
}

TEST(Stamps, BelieveAClockThatWasSetBackOnceSeveralAgree) {
  EXPECT_THAT(
      verdicts({50.0, 10.0, 10.1, 10.2, 10.3}),
      ElementsAre(Stamp::Next, Stamp::OutOfOrder, Stamp::OutOfOrder, Stamp::SetBack, Stamp::Next));
}

TEST(Stamps, GoOnAfterAStampFromTheFarFuture) {
  EXPECT_THAT(verdicts({5.0, 9e9, 5.1, 5.2, 5.3, 5.4}),
              ElementsAre(Stamp::Next, Stamp::Ahead, Stamp::OutOfOrder, Stamp::OutOfOrder,
                          Stamp::SetBack, Stamp::Next));
}

TEST(Stamps, AreNotFooledByAFewOldMessages) {
  EXPECT_THAT(verdicts({50.0, 10.0, 50.1, 10.1, 50.2, 10.2}),
              ElementsAre(Stamp::Next, Stamp::OutOfOrder, Stamp::Next, Stamp::OutOfOrder,
                          Stamp::Next, Stamp::OutOfOrder));
  EXPECT_THAT(verdicts({50.0, 12.0, 11.0, 10.0}),
              ElementsAre(Stamp::Next, Stamp::OutOfOrder, Stamp::OutOfOrder, Stamp::OutOfOrder));
}

TEST(Stamps, NameTheParameterThatIsOutOfRange) {
  EXPECT_THROW(StampMonitor({.agreement = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
