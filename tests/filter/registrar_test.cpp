#include "filter/registrar.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "tests/support/similarity_registration.hpp"

namespace sketchloc {
namespace {

/// Says that every prior is right; remembers what it was asked.
class Recorder final : public WarpPredictor {
 public:
  std::vector<std::optional<Registration>> predict(std::span<const PlacedScan> submap,
                                                   const SketchCropper&,
                                                   std::span<const Sim2> priors) override {
    scans = submap.size();
    asked.assign(priors.begin(), priors.end());
    std::vector<std::optional<Registration>> results;
    for (const Sim2& prior : priors) {
      results.push_back(testing::similarity_registration(prior, 1.0));
    }
    if (knows_no_covariance && !results.empty()) {
      results.front()->covariance = std::nullopt;
    }
    return results;
  }

  std::size_t scans = 0;
  std::vector<Sim2> asked;
  bool knows_no_covariance = false;
};

Sketch small_drawing() {
  Sketch sketch;
  sketch.occupied = Grid<std::uint8_t>(100, 100);
  sketch.occupied.at({50, 50}) = 1;
  return sketch;
}

Scan scan_of(float range_m) {
  return {.first_angle_rad = 0.0,
          .angle_step_rad = 0.1,
          .max_range_m = 30.0,
          .robot_from_laser = {},
          .ranges_m = {range_m}};
}

Mode mode_at(double x_px, double weight) {
  return {.sketch_from_robot = Sim2::from_xy_yaw_scale(x_px, 40.0, 0.0, 10.0),
          .covariance = Eigen::Matrix4d::Identity(),
          .weight = weight};
}

TEST(Registrar, IsDueAfterAWayOrATurnButNotForAScanThatSawNothing) {
  Recorder recorder;
  Registrar registrar(small_drawing(), recorder, {.way_m = 0.5, .turn_rad = 0.3});
  registrar.add(scan_of(2.0F), Se2(), Se2());
  EXPECT_TRUE(registrar.is_due());  // never looked
  const std::vector<Mode> modes = {mode_at(20.0, 1.0)};
  registrar.look(modes, Se2());
  EXPECT_FALSE(registrar.is_due());
  registrar.add(scan_of(2.0F), Se2::from_xy_yaw(0.4, 0, 0), Se2::from_xy_yaw(0.4, 0, 0));
  EXPECT_FALSE(registrar.is_due());
  registrar.add(scan_of(40.0F), Se2::from_xy_yaw(0.6, 0, 0), Se2::from_xy_yaw(0.2, 0, 0));
  EXPECT_FALSE(registrar.is_due());
  registrar.add(scan_of(2.0F), Se2::from_xy_yaw(0.6, 0, 0), Se2());
  EXPECT_TRUE(registrar.is_due());
  registrar.look(modes, Se2());
  registrar.add(scan_of(2.0F), Se2::from_xy_yaw(0.6, 0, 0.4), Se2::from_xy_yaw(0, 0, 0.4));
  EXPECT_TRUE(registrar.is_due());
}

TEST(Registrar, AsksFromTheHeaviestModesAsTheRobotMoved) {
  Recorder recorder;
  Registrar registrar(small_drawing(), recorder, {.max_modes = 2});
  registrar.add(scan_of(2.0F), Se2(), Se2());
  const std::vector<Mode> modes = {mode_at(20.0, 0.5), mode_at(60.0, 0.3), mode_at(80.0, 0.2)};
  registrar.look(modes, Se2::from_xy_yaw(0.5, 0.0, 0.0));
  ASSERT_EQ(recorder.asked.size(), 2U);
  EXPECT_NEAR(recorder.asked[1].x(), 65.0, 1e-9);
  EXPECT_EQ(registrar.likelihoods().size(), 2U);
}

TEST(Registrar, GivesEachParticleTheLikelihoodOfItsNearestMode) {
  Recorder recorder;
  Registrar registrar(small_drawing(), recorder, {});
  registrar.add(scan_of(2.0F), Se2(), Se2());
  const std::vector<Mode> modes = {mode_at(20.0, 0.5), mode_at(60.0, 0.5)};
  registrar.look(modes, Se2());
  ParticleSet particles;
  particles.resize(4);
  const float x_px[] = {25.0F, 45.0F, 95.0F, 20.0F};
  for (std::size_t i = 0; i < 4; ++i) {
    particles.x_px[i] = x_px[i];
    particles.y_px[i] = 40.0F;
  }
  particles.heading_rad[3] = 3.0F;  // in the right place, headed the wrong way
  std::vector<std::int8_t> likelihood_of;
  registrar.assign(particles, {.radius_m = 3.0}, likelihood_of);
  EXPECT_EQ(likelihood_of, (std::vector<std::int8_t>{0, 1, kNoLikelihood, kNoLikelihood}));
}

TEST(Registrar, LeavesOutWhatDoesNotSayHowSureItIs) {
  Recorder recorder;
  recorder.knows_no_covariance = true;
  Registrar registrar(small_drawing(), recorder, {});
  registrar.add(scan_of(2.0F), Se2(), Se2());
  const std::vector<Mode> modes = {mode_at(20.0, 0.5), mode_at(60.0, 0.5)};
  registrar.look(modes, Se2());
  ASSERT_EQ(registrar.likelihoods().size(), 1U);
  EXPECT_NEAR(registrar.likelihoods().front().mean[0], 60.0, 1e-6);
}

TEST(FusionParams, RefuseWhatIsOutOfRange) {
  EXPECT_NO_THROW(validate(FusionParams{}));
  EXPECT_THROW(validate(FusionParams{.max_modes = 0}), std::invalid_argument);
  EXPECT_THROW(validate(FusionParams{.independent_way_m = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
