#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>

#include "filter/localizer.hpp"
#include "motion/state_bytes.hpp"
#include "tests/support/two_rooms.hpp"

namespace sketchloc {
namespace {

using testing::Drive;
using testing::drive_through_the_door;
using testing::KnowsTheWay;
using testing::kPxPerM;
using testing::two_rooms;

LocalizerParams lively_params() {
  LocalizerParams params;
  params.particles = {.min_particles = 800, .max_particles = 1500};
  params.recovery.base_share = 0.02;
  params.recovery.max_share = 0.05;
  return params;
}

std::string bytes_of(const Localizer& localizer) {
  StateWriter state;
  localizer.save(state);
  return state.bytes();
}

void load(Localizer& localizer, const std::string& bytes) {
  StateReader state(bytes);
  localizer.load(state);
  EXPECT_TRUE(state.at_end());
}

class LocalizerState : public ::testing::Test {
 protected:
  void drive(Localizer& localizer, std::size_t begin, std::size_t end) const {
    for (std::size_t i = begin; i < end; ++i) {
      localizer.step(drive_.scans[i], drive_.odom_from_robot[i]);
    }
  }
  void expect_same_after_a_restart(WarpPredictor* predictor) const {
    Localizer whole(sketch_, lively_params(), predictor);
    whole.start_at(drive_.sketch_from_robot.front());
    drive(whole, 0, 17);
    const std::string kept = bytes_of(whole);
    drive(whole, 17, drive_.scans.size());

    Localizer resumed(sketch_, lively_params(), predictor);
    load(resumed, kept);
    EXPECT_EQ(bytes_of(resumed), kept);
    drive(resumed, 17, drive_.scans.size());
    EXPECT_EQ(bytes_of(resumed), bytes_of(whole));
  }

  Sketch sketch_ = two_rooms();
  Drive drive_ = drive_through_the_door(sketch_);
};

TEST_F(LocalizerState, GoesOnWithTheSameBytes) { expect_same_after_a_restart(nullptr); }

TEST_F(LocalizerState, GoesOnWithTheSameBytesWithRegistrations) {
  KnowsTheWay predictor(drive_);
  expect_same_after_a_restart(&predictor);
  EXPECT_GT(predictor.looks, 10);
}

TEST_F(LocalizerState, IsRefusedWhereItIsDamaged) {
  Localizer localizer(sketch_, lively_params());
  localizer.start_at(drive_.sketch_from_robot.front());
  drive(localizer, 0, 3);
  const std::string kept = bytes_of(localizer);
  for (std::size_t length = 0; length < kept.size(); length += 997) {
    EXPECT_THROW(load(localizer, kept.substr(0, length)), std::runtime_error);
  }
  std::string wrong = kept;
  wrong[12] = '\xff';  // a coordinate that is no number
  wrong[13] = '\xff';
  wrong[14] = '\xff';
  wrong[15] = '\xff';
  EXPECT_THROW(load(localizer, wrong), std::runtime_error);
}

TEST_F(LocalizerState, IsRefusedByALocalizerWithOtherRegistrations) {
  KnowsTheWay predictor(drive_);
  Localizer with(sketch_, lively_params(), &predictor);
  with.start_at(drive_.sketch_from_robot.front());
  drive(with, 0, 3);
  Localizer without(sketch_, lively_params());
  EXPECT_THROW(load(without, bytes_of(with)), std::runtime_error);
}

TEST_F(LocalizerState, SpreadsAsFarAsItIsTold) {
  LocalizerParams params = lively_params();
  params.start = {.position_m = 0.0, .heading_rad = 0.0, .log_scale = 0.0};
  Localizer localizer(sketch_, params);
  localizer.start_at(drive_.sketch_from_robot.front());
  localizer.spread(0.5, 0.2);
  const auto sigma = [](const std::vector<float>& values) {
    const double count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double sum = 0.0;
    for (const float value : values) {
      sum += (value - mean) * (value - mean);
    }
    return std::sqrt(sum / count);
  };
  // Five standard errors of a standard deviation.
  const double share = 5.0 / std::sqrt(2.0 * static_cast<double>(localizer.particles().size()));
  EXPECT_NEAR(sigma(localizer.particles().x_px), 0.5 * kPxPerM, share * 0.5 * kPxPerM);
  EXPECT_NEAR(sigma(localizer.particles().y_px), 0.5 * kPxPerM, share * 0.5 * kPxPerM);
  EXPECT_NEAR(sigma(localizer.particles().heading_rad), 0.2, share * 0.2);
}

TEST_F(LocalizerState, KeepsToTheBudgetOfAStep) {
  KnowsTheWay predictor(drive_);
  Localizer localizer(sketch_, lively_params(), &predictor);
  localizer.start_at(drive_.sketch_from_robot.front());
  drive(localizer, 0, 3);
  const int looks = predictor.looks;
  for (std::size_t i = 3; i < 20; ++i) {
    const StepReport& report = localizer.step(drive_.scans[i], drive_.odom_from_robot[i],
                                              {.max_particles = 300, .may_register = false});
    EXPECT_LE(report.particles, 300U);
    EXPECT_FALSE(report.looked);
    EXPECT_TRUE(report.limited);
  }
  EXPECT_EQ(predictor.looks, looks);
  EXPECT_LE(localizer.particles().size(), 300U);
  const StepReport& free = localizer.step(drive_.scans[20], drive_.odom_from_robot[20]);
  EXPECT_TRUE(free.looked);
  drive(localizer, 21, drive_.scans.size());
  EXPECT_GE(localizer.particles().size(), 800U) << "the particles come back";
  EXPECT_FALSE(localizer.step(drive_.scans.back(), drive_.odom_from_robot.back()).limited);
}

}  // namespace
}  // namespace sketchloc
