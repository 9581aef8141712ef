#include "eval/keyframe_io.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using ::testing::HasSubstr;

KeyframeRun small_run() {
  KeyframeRun run{.start_sketch_from_robot = Sim2::from_xy_yaw_scale(1.5, 2.5, 0.1, 20.0)};
  run.keyframes = {{.step = 3, .time_s = 1.25, .odom_from_robot = {}, .way_m = 0.0},
                   {.step = 9,
                    .time_s = 2.5,
                    .odom_from_robot = Se2::from_xy_yaw(0.1, 0.2, 0.3),
                    .way_m = 0.6,
                    .turn_rad = 0.2}};
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Identity() / 3.0;
  covariance(0, 3) = covariance(3, 0) = 0.01;
  run.keyframes[1].hypotheses = {
      {.sketch_from_robot = Sim2::from_xy_yaw_scale(10.0, 20.0, -1.0, 25.0),
       .covariance = covariance,
       .inlier_probability = 0.7}};
  run.pairs = {{.earlier = 0,
                .later = 1,
                .earlier_from_later = Se2::from_xy_yaw(0.3, -0.1, 3.0),
                .probability = 0.9}};
  return run;
}

class KeyframeIo : public ::testing::Test {
 protected:
  KeyframeRun read(const std::string& text) const {
    std::ofstream(folder_ / "keyframes.jsonl") << text;
    return read_keyframes(folder_ / "keyframes.jsonl");
  }
  std::string complaint(const std::string& text) const {
    try {
      read(text);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "none";
  }

  testing::TemporaryDirectory folder_;
};

TEST_F(KeyframeIo, ReadsWhatItWrote) {
  const KeyframeRun run = small_run();
  const KeyframeRun back = read(to_jsonl(run));
  ASSERT_EQ(back.keyframes.size(), 2U);
  EXPECT_NEAR(back.start_sketch_from_robot->scale(), 20.0, 1e-12);
  EXPECT_EQ(back.keyframes[0].step, 3U);
  EXPECT_EQ(back.keyframes[1].way_m, 0.6);
  EXPECT_EQ(back.keyframes[1].turn_rad, 0.2);
  EXPECT_NEAR(back.keyframes[1].odom_from_robot.yaw_rad(), 0.3, 1e-15);
  const PoseHypothesis& one = back.keyframes[1].hypotheses.at(0);
  EXPECT_EQ(one.covariance, run.keyframes[1].hypotheses[0].covariance);
  EXPECT_EQ(one.inlier_probability, 0.7);
  EXPECT_NEAR(one.sketch_from_robot.yaw_rad(), -1.0, 1e-15);
}

TEST_F(KeyframeIo, KnowsRunsThatStartedAnywhere) {
  KeyframeRun run = small_run();
  run.start_sketch_from_robot.reset();
  EXPECT_FALSE(read(to_jsonl(run)).start_sketch_from_robot);
}

TEST_F(KeyframeIo, SaysWhereAFileIsWrong) {
  const std::string start = "{\"start_sketch_from_robot\": null}\n";
  EXPECT_THAT(complaint(""), HasSubstr("has no keyframes"));
  EXPECT_THAT(complaint(start), HasSubstr("localize --smooth"));
  EXPECT_THAT(complaint(start + "{\"step\": 1}\n"), HasSubstr("keyframes.jsonl:2: "));
  EXPECT_THAT(complaint("{\"start_sketch_from_robot\": [1, 2, 3]}\n"),
              HasSubstr("expected 4 numbers, found 3"));
  EXPECT_THAT(complaint("{\"start_sketch_from_robot\": [1, 2, 3, -4]}\n"),
              HasSubstr("a scale above 0"));
  KeyframeRun run = small_run();
  run.keyframes[1].hypotheses[0].covariance.setZero();
  EXPECT_THAT(complaint(to_jsonl(run)), HasSubstr("expected a covariance"));
  run = small_run();
  run.keyframes[1].step = 3;
  EXPECT_THAT(complaint(to_jsonl(run)), HasSubstr("steps do not increase"));
}

}  // namespace
}  // namespace sketchloc
