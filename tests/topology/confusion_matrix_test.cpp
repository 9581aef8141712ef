#include "topology/confusion_matrix.hpp"

#include <gtest/gtest.h>

namespace sketchloc {
namespace {

/// Of three that are 0 one was called 1; of one that is 1 none was called otherwise.
ConfusionMatrix worked_out_by_hand() {
  ConfusionMatrix confusion(3);
  confusion.add(0, 0);
  confusion.add(0, 0);
  confusion.add(0, 1);
  confusion.add(1, 1);
  return confusion;
}

TEST(ConfusionMatrix, CountsRightAnswers) {
  EXPECT_EQ(worked_out_by_hand().count(), 4);
  EXPECT_DOUBLE_EQ(worked_out_by_hand().accuracy(), 0.75);
}

TEST(ConfusionMatrix, TellsRecallAndPrecisionOfAnAnswer) {
  EXPECT_DOUBLE_EQ(worked_out_by_hand().recall(0), 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(worked_out_by_hand().precision(0), 1.0);
  EXPECT_DOUBLE_EQ(worked_out_by_hand().recall(1), 1.0);
  EXPECT_DOUBLE_EQ(worked_out_by_hand().precision(1), 0.5);
}

TEST(ConfusionMatrix, HasNothingToTellOfAnAnswerThatNeverWas) {
  EXPECT_EQ(worked_out_by_hand().recall(2), 0.0);
  EXPECT_EQ(worked_out_by_hand().precision(2), 0.0);
  EXPECT_EQ(ConfusionMatrix(3).accuracy(), 0.0);
}

}  // namespace
}  // namespace sketchloc
