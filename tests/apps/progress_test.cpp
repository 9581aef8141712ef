#include "apps/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <sstream>

#include "apps/interrupt.hpp"

namespace sketchloc {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

class ProgressTest : public ::testing::Test {
 protected:
  Progress::Sink sink(bool is_terminal) {
    return {.out = &out_, .is_terminal = is_terminal, .now = [this] { return now_; }};
  }

  std::ostringstream out_;
  Progress::Clock::time_point now_{};
};

TEST_F(ProgressTest, SaysEveryTenthInAFile) {
  {
    Progress progress("localize", 1000, sink(false));
    for (std::size_t done = 1; done <= 1000; ++done) {
      now_ += milliseconds(100);
      progress.update(done);
    }
  }
  const std::string text = out_.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10);
  EXPECT_THAT(text, HasSubstr("localize  10 %, 1:30 min left\n"));
  EXPECT_THAT(text, HasSubstr("localize 100 %, took 1:40 min\n"));
}

TEST_F(ProgressTest, RedrawsOneLineTenTimesASecondOnATerminal) {
  {
    Progress progress("localize", 1000, sink(true));
    for (std::size_t done = 1; done <= 1000; ++done) {
      now_ += milliseconds(1);
      progress.update(done);
    }
  }
  const std::string text = out_.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 10);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
  EXPECT_THAT(text, HasSubstr("\rlocalize  10 %, 1 s left"));
}

TEST_F(ProgressTest, EndsTheLineWhereTheWorkStopsEarly) {
  { Progress("localize", 10, sink(true)); }
  EXPECT_EQ(out_.str(), "");
  {
    Progress progress("localize", 10, sink(true));
    now_ += milliseconds(200);
    progress.update(1);
  }
  EXPECT_EQ(out_.str().back(), '\n');
}

TEST_F(ProgressTest, SaysNothingAboutNoWork) {
  Progress progress("localize", 0, sink(false));
  progress.update(0);
  EXPECT_EQ(out_.str(), "");
}

TEST_F(ProgressTest, StopsAfterAnInterrupt) {
  catch_interrupts();
  Progress progress("localize", 10, sink(false));
  EXPECT_NO_THROW(progress.update(1));
  std::raise(SIGINT);
  EXPECT_THROW(progress.update(2), Interrupted);
  catch_interrupts();
  EXPECT_NO_THROW(progress.update(3));
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

}  // namespace
}  // namespace sketchloc
