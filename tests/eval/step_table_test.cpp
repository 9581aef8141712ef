#include "eval/step_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>
#include <string>

#include "tests/eval/synthetic_run.hpp"
#include "tests/support/matchers.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using ::testing::HasSubstr;
using testing::IsNear;
using testing::TemporaryDirectory;
using ::testing::ThrowsMessage;

class StepTable : public ::testing::Test {
 protected:
  std::vector<StepReport> read_back(const std::string& text) {
    std::ofstream(folder_ / "trajectory.csv") << text;
    return read_step_table(folder_ / "trajectory.csv");
  }

  const std::vector<StepReport> steps_ =
      testing::make_synthetic_run(testing::Outcome::Recovered).steps;
  TemporaryDirectory folder_;
};

TEST_F(StepTable, ReadsBackWhatWasWritten) {
  const std::vector<StepReport> read = read_back(step_table_csv(steps_));
  ASSERT_EQ(read.size(), steps_.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].step, steps_[i].step);
    EXPECT_EQ(read[i].time_s, steps_[i].time_s);
    EXPECT_THAT(read[i].estimate.sketch_from_robot,
                IsNear(steps_[i].estimate.sketch_from_robot, 1e-12));
    EXPECT_EQ(read[i].estimate.covariance, steps_[i].estimate.covariance);
    EXPECT_EQ(read[i].particles, steps_[i].particles);
    EXPECT_EQ(read[i].updated, steps_[i].updated);
    EXPECT_EQ(read[i].injected_share, steps_[i].injected_share);
    EXPECT_EQ(read[i].localized_probability, steps_[i].localized_probability);
    EXPECT_EQ(read[i].challengers, steps_[i].challengers);
    EXPECT_EQ(read[i].found_anew, steps_[i].found_anew);
  }
}

TEST_F(StepTable, ReadsWholeNumbersInEveryForm) {
  std::vector<StepReport> steps(steps_.begin(), steps_.begin() + 1);
  steps[0].step = 100'000;
  const std::string written = step_table_csv(steps);
  EXPECT_THAT(written, HasSubstr("\n100000,"));
  std::string short_form = written;
  short_form.replace(short_form.find("\n100000,") + 1, 6, "1e+05");
  EXPECT_EQ(read_back(short_form).at(0).step, 100'000U);
}

TEST_F(StepTable, SaysWhatIsWrongAndWhere) {
  const std::string good = step_table_csv(std::span(steps_).first(2));
  const auto fails_with = [&](const std::string& text, const std::string& message) {
    EXPECT_THAT([&] { read_back(text); }, ThrowsMessage<std::runtime_error>(HasSubstr(message)));
  };
  fails_with("a,b\n", "trajectory.csv:1: header: expected one column \"step\"");
  fails_with(step_table_csv({}), "rows: expected at least one");
  fails_with(good + "1,2,3\n", "trajectory.csv:4: columns: expected 26 as in the header");
  fails_with(good.substr(0, good.size() - 10) + "x\n", "trajectory.csv:3:");
  fails_with(good + good.substr(good.find('\n') + 1), "trajectory.csv:4: step: expected more than");
  std::string nan = good;
  nan.replace(nan.find("\n1,") + 3, 1, "nan");
  fails_with(nan, "time_s: expected a number");
  for (const char* step : {"1e300", "-1", "1.5", "nan", "inf", "18446744073709551616"}) {
    std::string wrong = good;
    wrong.replace(wrong.find("\n1,") + 1, 1, step);
    fails_with(wrong, "step: expected a whole number from 0 to 9007199254740992");
  }
}

TEST_F(StepTable, SaysThatAFileIsMissing) {
  EXPECT_THROW(read_step_table(folder_ / "no.csv"), std::runtime_error);
}

}  // namespace
}  // namespace sketchloc
