#include "filter/beam_kernel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "tests/support/grids.hpp"
#include "tests/support/particle_cloud.hpp"
#include "tests/support/scalar_beam_model.hpp"
#include "tests/support/vector_targets.hpp"

namespace sketchloc {
namespace {

using testing::ParticleCloud;

std::vector<Beam> fan(int beams, int every_nth_without_return) {
  std::vector<Beam> fan;
  for (int i = 0; i < beams; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(beams);
    fan.push_back({.bearing_rad = 4.7F * share - 2.35F,
                   .range_m = 0.4F + 7.0F * std::abs(std::sin(9.0F * share)),
                   .returned = i % every_nth_without_return != 0,
                   .log_stretch = 0.1F * std::cos(5.0F * share)});
  }
  return fan;
}

std::vector<float> score(const BeamKernel& kernel, const ParticleSpans& particles,
                         std::span<const Beam> beams) {
  PreparedBeams prepared;
  kernel.prepare(beams, prepared);
  std::vector<float> scores(particles.size());
  kernel.score(particles, prepared, scores);
  return scores;
}

/// What the kernel promises, in double from the table: heading and ratio rounded once each.
std::vector<double> score_from_table(const RangeTable& table, const BeamKernelParams& params,
                                     const ParticleSpans& particles, std::span<const Beam> beams,
                                     double ratio_shift) {
  std::vector<double> scores;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    double sum = 0.0;
    for (const Beam& beam : beams) {
      const std::optional<double> expected =
          table.range_px({particles.x_px[i], particles.y_px[i]},
                         static_cast<double>(particles.heading_rad[i]) + beam.bearing_rad);
      const double least = table.range_px(RangeTable::kNearest);
      const double measured =
          std::max(least, static_cast<double>(beam.range_m) * std::exp(particles.log_scale[i]) *
                              std::exp(beam.log_stretch));
      const double log_ratio = std::log(measured / expected.value_or(1e9));
      const double z = std::max(0.0, std::abs(log_ratio) + ratio_shift) / params.sigma;
      sum += std::log((1.0 - params.floor) * std::exp(-0.5 * z * z) + params.floor);
    }
    scores.push_back(sum);
  }
  return scores;
}

class BeamKernelWith : public ::testing::TestWithParam<int> {};

TEST_P(BeamKernelWith, GivesTheSameBitsWithEveryInstructionSet) {
  const Grid<std::uint8_t> occupied = testing::thin_strokes(90, 70, 20, 3);
  const RangeTable table(occupied);
  const BeamKernel kernel(table, BeamKernelParams{});
  const BeamKernel nothing_kernel(table, BeamKernelParams{.nothing_drawn = -0.9});
  ParticleCloud cloud = testing::spread_cloud(515, 94, 74, 12.0, 5);
  ParticleCloud strained = cloud;
  strained.strain(8);
  for (const ParticleCloud& particles : {cloud, strained}) {
    for (const BeamKernel* each : {&kernel, &nothing_kernel}) {
      const std::vector<Beam> beams = fan(GetParam(), each == &kernel ? 3 : 1000);
      const std::vector<float> scores = score(*each, particles.spans(), beams);
      for (const std::int64_t target : testing::vector_targets()) {
        const testing::OnlyTarget only(target);
        EXPECT_EQ(score(*each, particles.spans(), beams), scores) << hwy::TargetName(target);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Beams, BeamKernelWith, ::testing::Values(1, 7, 60, 64, 65, 181));

TEST(BeamKernel, AddsTheKernelOfEachBeamToWithinOneStepOfTheTable) {
  const Grid<std::uint8_t> occupied = testing::rooms(230, 170, 57, 12);
  const RangeTable table(occupied);
  const BeamKernelParams params;
  const BeamKernel kernel(table, params);
  std::vector<Beam> beams = fan(60, 1000);
  beams.erase(beams.begin());
  const ParticleCloud cloud = testing::spread_cloud(300, 230, 170, 12.0, 5);
  const std::vector<float> scores = score(kernel, cloud.spans(), beams);
  const double step = 0.51 * table.params().log_step;  // half, for rounding; some for float
  const auto worse = score_from_table(table, params, cloud.spans(), beams, step);
  const auto better = score_from_table(table, params, cloud.spans(), beams, -step);
  for (std::size_t i = 0; i < scores.size(); ++i) {
    // A beam that points between two headings may be rounded to either: one beam's worth of slack.
    ASSERT_GE(scores[i], worse[i] + std::log(params.floor) - 1e-3);
    ASSERT_LE(scores[i], better[i] - std::log(params.floor) + 1e-3);
  }
}

TEST(BeamKernel, PrefersTheTruePose) {
  const Grid<std::uint8_t> occupied = testing::rooms(230, 170, 57, 12);
  const RangeTable table(occupied);
  const BeamKernel kernel(table, BeamKernelParams{});
  std::vector<Beam> beams = fan(60, 1000);
  for (Beam& beam : beams) {
    const auto range = table.range_px({80.5, 70.5}, 0.3 + beam.bearing_rad);
    beam = {.bearing_rad = beam.bearing_rad,
            .range_m = static_cast<float>(range.value_or(20.0)) / 15.0F};
  }
  ParticleCloud cloud = testing::spread_cloud(500, 230, 170, 15.0, 9);
  cloud.add(80.5F, 70.5F, 0.3F, 15.0F);
  cloud.add(80.5F, 70.5F, 0.3F + 20.0F * std::numbers::pi_v<float>, 15.0F);
  const std::vector<float> scores = score(kernel, cloud.spans(), beams);
  EXPECT_EQ(std::ranges::max_element(scores) - scores.begin(), 500);
  EXPECT_FLOAT_EQ(scores[500], scores[501]);
  EXPECT_GT(scores[500], -0.5F);
}

TEST(BeamKernel, GivesTheLeastScoreOutsideTheDrawing) {
  const Grid<std::uint8_t> occupied = testing::rooms(230, 170, 57, 12);
  const RangeTable table(occupied);
  const BeamKernelParams params{.sigma = 0.3, .floor = 0.2, .no_return_floor = 0.4};
  const BeamKernel kernel(table, params);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  ParticleCloud cloud;
  for (const float outside : {-0.01F, 230.0F, 1e30F, kNan}) {
    cloud.add(outside, 50.0F, 0.0F, 15.0F);
  }
  cloud.add(50.0F, -1.0F, 0.0F, 15.0F);
  cloud.add(50.0F, 170.0F, 0.0F, 15.0F);
  cloud.add(50.0F, 50.0F, 0.0F, 0.0F);
  cloud.add(50.0F, 50.0F, 0.0F, kNan);
  const std::vector<float> scores = score(kernel, cloud.spans(), fan(30, 3));
  for (const float value : scores) {
    EXPECT_FLOAT_EQ(value, static_cast<float>(30.0 * std::log(0.2)));
  }
}

TEST(BeamKernel, ReadsAnyKernelAndEachKindOfBeamWithItsOwn) {
  Grid<std::uint8_t> occupied(200, 5);
  occupied.at({150, 2}) = 1;
  const RangeTable table(occupied);
  const BeamKernel kernel(
      table, [](double d) { return 2.0 + d; }, [](double d) { return -3.0 - 2.0 * d; });
  ParticleCloud cloud;
  cloud.add(50.5F, 2.5F, 0.0F, 10.0F);  // expects 99.5 px
  const Beam seen{.bearing_rad = 0.0F, .range_m = 5.0F};
  const Beam lost{.bearing_rad = 0.0F, .range_m = 20.0F, .returned = false};
  const Beam stretched{.bearing_rad = 0.0F, .range_m = 5.0F, .log_stretch = 0.5F};
  const double d_seen = std::log(50.0 / 99.5);
  const double d_lost = std::log(200.0 / 99.5);
  const double rounding = 0.031;  // the table's half step and the kernel's
  EXPECT_NEAR(score(kernel, cloud.spans(), {{seen}})[0], 2.0 + d_seen, rounding);
  EXPECT_NEAR(score(kernel, cloud.spans(), {{stretched}})[0], 2.5 + d_seen, rounding);
  EXPECT_NEAR(score(kernel, cloud.spans(), {{lost}})[0], -3.0 - 2.0 * d_lost, 2 * rounding);
  EXPECT_NEAR(score(kernel, cloud.spans(), {{seen, lost}})[0], -1.0 + d_seen - 2.0 * d_lost,
              3 * rounding);
}

TEST(BeamKernel, HoldsLargeStrainsAndScalesAtTheFinestStepOfTheTable) {
  Grid<std::uint8_t> occupied(200, 5);
  occupied.at({150, 2}) = 1;
  for (const double log_step : {0.025, 0.03, 0.1}) {
    const RangeTable table(occupied, {.log_step = log_step});
    const BeamKernel kernel(
        table, [](double d) { return 2.0 + d; }, [](double) { return 0.0; });
    for (const float strain : {-1.5F, -1.0F, 0.0F, 0.7F, 1.5F}) {
      for (const float px_per_m : {1.0F, 20.0F, 500.0F}) {
        ParticleCloud cloud;
        cloud.add(50.5F, 2.5F, 0.0F, px_per_m);  // expects 99.5 px
        cloud.axial_strain = {strain};
        cloud.diagonal_strain = {0.0F};
        const Beam beam{.bearing_rad = 0.0F, .range_m = 110.0F / px_per_m / std::exp(strain)};
        EXPECT_NEAR(score(kernel, cloud.spans(), {{beam}})[0], 2.0 + std::log(110.0 / 99.5),
                    1.6 * log_step)
            << "step " << log_step << ", strain " << strain << ", scale " << px_per_m;
      }
    }
  }
}

TEST(BeamKernel, TakesNoBeamsAndNoParticles) {
  const RangeTable table(testing::rooms(60, 60, 20, 4));
  const BeamKernel kernel(table, BeamKernelParams{});
  ParticleCloud cloud;
  EXPECT_TRUE(score(kernel, cloud.spans(), fan(10, 3)).empty());
  cloud.add(30.0F, 30.0F, 0.0F, 10.0F);
  EXPECT_EQ(score(kernel, cloud.spans(), {}), std::vector<float>{0.0F});
}

TEST(BeamKernel, RefusesParametersOutOfRange) {
  EXPECT_THROW(validate(BeamKernelParams{.sigma = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(BeamKernelParams{.floor = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(BeamKernelParams{.no_return_floor = 1.1}), std::invalid_argument);
}

TEST(BeamKernel, KnowsBeamsThatReturnedWhereNothingIsDrawn) {
  const RangeTable table(Grid<std::uint8_t>(50, 50));
  const BeamKernel kernel(table, BeamKernelParams{.nothing_drawn = -0.5});
  const BeamKernel plain(table, BeamKernelParams{.floor = 0.2});
  ParticleCloud cloud;
  cloud.add(20.0F, 30.0F, 0.0F, 10.0F);
  const Beam seen{.bearing_rad = 0.0F, .range_m = 2.0F};
  const Beam lost{.bearing_rad = 0.0F, .range_m = 20.0F, .returned = false};
  EXPECT_NEAR(score(kernel, cloud.spans(), {{seen}})[0], -0.5, 1e-4);
  EXPECT_NEAR(score(kernel, cloud.spans(), {{lost}})[0], 0.0, 1e-4);
  EXPECT_NEAR(score(plain, cloud.spans(), {{seen}})[0], std::log(0.2), 1e-4);
}

TEST(BeamKernel, StretchesAndTurnsBeamsByTheStrainOfTheParticle) {
  Grid<std::uint8_t> occupied(300, 300);
  for (int i = 0; i < 300; ++i) {
    occupied.at({250, i}) = 1;
    occupied.at({i, 250}) = 1;
  }
  const RangeTable table(occupied);
  const BeamKernel kernel(
      table, [](double d) { return d; }, [](double d) { return d; });
  ParticleCloud cloud;
  cloud.add(150.5F, 150.5F, 0.0F, 10.0F);
  cloud.strain(1);
  cloud.axial_strain = {0.4F};
  cloud.diagonal_strain = {0.0F};
  const Beam ahead{.bearing_rad = 0.0F, .range_m = 5.0F};
  const Beam left{.bearing_rad = 0.5F * std::numbers::pi_v<float>, .range_m = 5.0F};
  EXPECT_NEAR(score(kernel, cloud.spans(), {{ahead}})[0], std::log(50.0 / 99.5) + 0.4, 0.04);
  EXPECT_NEAR(score(kernel, cloud.spans(), {{left}})[0], std::log(50.0 / 99.5) - 0.4, 0.04);
  // 45 deg is turned towards the x axis: atan(exp(-0.8)) = 24.2 deg, and cosh(0.8) is the square of
  // the stretch; the wall is 99.5 px / cos(24.2 deg) away.
  const Beam between{.bearing_rad = 0.25F * std::numbers::pi_v<float>, .range_m = 5.0F};
  EXPECT_NEAR(score(kernel, cloud.spans(), {{between}})[0],
              std::log(50.0 / 109.1) + 0.5 * std::log(std::cosh(0.8)), 0.05);
}

/// How far scores are from those of exact rays from the exact poses, in units of the spread between
/// particles.
double relative_error(const ParticleCloud& cloud) {
  const Grid<std::uint8_t> occupied = testing::rooms(400, 400, 80, 20);
  const RangeTable table(occupied);
  const BeamKernelParams params;
  const BeamKernel kernel(table, params);
  const std::vector<Beam> beams = fan(60, 20);
  const std::vector<float> scores = score(kernel, cloud.spans(), beams);
  const std::vector<double> exact =
      testing::score_by_traversal(occupied, params, cloud.spans(), beams, 1e9);
  double mean = 0.0;
  for (const double value : exact) {
    mean += value / static_cast<double>(exact.size());
  }
  double error = 0.0;
  double spread = 0.0;
  for (std::size_t i = 0; i < scores.size(); ++i) {
    error += (scores[i] - exact[i]) * (scores[i] - exact[i]);
    spread += (exact[i] - mean) * (exact[i] - mean);
  }
  return std::sqrt(error / spread);
}

TEST(BeamKernelStatistical, FollowsTheExactModel) {
  ParticleCloud cloud = testing::spread_cloud(1000, 400, 400, 10.0, 1);
  EXPECT_LT(relative_error(cloud), 0.15);
  cloud.strain(2);
  EXPECT_LT(relative_error(cloud), 0.2);
}

}  // namespace
}  // namespace sketchloc
