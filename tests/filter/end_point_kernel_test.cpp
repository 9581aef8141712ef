#include "filter/end_point_kernel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "registration/distance_field.hpp"
#include "tests/support/grids.hpp"
#include "tests/support/particle_cloud.hpp"
#include "tests/support/scalar_end_point_model.hpp"
#include "tests/support/vector_targets.hpp"

namespace sketchloc {
namespace {

using testing::ParticleCloud;

struct Scan {
  std::vector<float> x_m;
  std::vector<float> y_m;

  EndPoints points() const { return {x_m, y_m}; }
};

Scan fan(int beams) {
  Scan scan;
  for (int i = 0; i < beams; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(beams);
    const float range_m = 0.4F + 7.0F * std::abs(std::sin(9.0F * share));
    scan.x_m.push_back(range_m * std::cos(3.1F * share - 1.5F));
    scan.y_m.push_back(range_m * std::sin(3.1F * share - 1.5F));
  }
  return scan;
}

Grid<float> field() {
  return likelihood_field(distance_field_px(testing::rooms(130, 170, 37, 8)), {.sigma_px = 3.0});
}

std::vector<float> score(const EndPointKernel& kernel, const ParticleSpans& particles,
                         const EndPoints& points) {
  std::vector<float> scores(particles.size());
  kernel.score(particles, points, scores);
  return scores;
}

class EndPointKernelWith : public ::testing::TestWithParam<int> {};

TEST_P(EndPointKernelWith, GivesTheSameBitsWithEveryInstructionSet) {
  const EndPointKernel kernel(field(), -3.0);
  const Scan scan = fan(GetParam());
  ParticleCloud cloud = testing::spread_cloud(300, 140, 180, 10.0, 3);
  for (int strained = 0; strained < 2; ++strained) {
    const std::vector<float> scores = score(kernel, cloud.spans(), scan.points());
    for (const std::int64_t target : testing::vector_targets()) {
      const testing::OnlyTarget only(target);
      EXPECT_EQ(score(kernel, cloud.spans(), scan.points()), scores) << hwy::TargetName(target);
    }
    cloud.strain(4);
  }
}

TEST_P(EndPointKernelWith, AddsTheLogLikelihoodsUnderTheEndPoints) {
  const Grid<float> log_likelihood = field();
  const EndPointKernel kernel(log_likelihood, -1.5);
  const Scan scan = fan(GetParam());
  ParticleCloud cloud = testing::spread_cloud(300, 140, 180, 10.0, 3);
  for (int strained = 0; strained < 2; ++strained) {
    const std::vector<float> scores = score(kernel, cloud.spans(), scan.points());
    const std::vector<double> exact =
        testing::score_by_look_up(log_likelihood, -1.5, cloud.spans(), scan.points());
    int off = 0;
    for (std::size_t i = 0; i < scores.size(); ++i) {
      off += std::abs(scores[i] - exact[i]) > 1e-4 * (1 + GetParam()) ? 1 : 0;
      ASSERT_NEAR(scores[i], exact[i], 3.0) << i;  // one point in another cell at the very most
    }
    // Some points lie within 1e-3 px of a side of a cell; 0.05 % are expected.
    EXPECT_LE(off, 3 + 300 * GetParam() / 1000);
    cloud.strain(4);
  }
}

INSTANTIATE_TEST_SUITE_P(Beams, EndPointKernelWith, ::testing::Values(1, 15, 16, 180, 361));

TEST(EndPointKernel, CountsPointsOutsideAsToldAndReadsTheOutermostCells) {
  Grid<float> corners(3, 2, 0.0F);
  corners.at({0, 0}) = -1.0F;
  corners.at({2, 1}) = -2.0F;
  const EndPointKernel kernel(corners, -7.0);
  const Scan scan{{0.0F}, {0.0F}};
  ParticleCloud cloud;
  for (const auto& [x, y] : std::vector<std::pair<float, float>>{{0.01F, 0.01F},
                                                                 {2.99F, 1.99F},
                                                                 {1.5F, 0.5F},  // inside
                                                                 {-0.01F, 0.5F},
                                                                 {3.0F, 0.5F},
                                                                 {1.5F, -0.01F},  // just outside
                                                                 {1.5F, 2.0F},
                                                                 {-1e9F, 1e9F},
                                                                 {1e30F, 0.5F}}) {
    cloud.add(x, y, 0.3F, 1.0F);
  }
  const std::vector<float> expected = {-1.0F, -2.0F, 0.0F,  -7.0F, -7.0F,
                                       -7.0F, -7.0F, -7.0F, -7.0F};
  const std::vector<float> scores = score(kernel, cloud.spans(), scan.points());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(scores[i], expected[i], 1e-4) << i;
  }
}

TEST(EndPointKernel, TakesParticlesThatAreNotFinite) {
  const EndPointKernel kernel(field(), -7.0);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Scan scan = fan(20);
  ParticleCloud cloud;
  cloud.add(kNan, 50.0F, 0.0F, 10.0F);
  cloud.add(50.0F, kInfinity, 0.0F, 10.0F);
  cloud.add(50.0F, 50.0F, kNan, 10.0F);
  cloud.add(50.0F, 50.0F, 0.0F, kNan);
  for (const float value : score(kernel, cloud.spans(), scan.points())) {
    EXPECT_NEAR(value, -140.0F, 1e-2);
  }
}

TEST(EndPointKernel, TakesNoPointsNoParticlesAndAnEmptyField) {
  const EndPointKernel kernel(Grid<float>(), -2.0);
  ParticleCloud cloud;
  EXPECT_TRUE(score(kernel, cloud.spans(), fan(3).points()).empty());
  cloud.add(1.0F, 2.0F, 0.0F, 1.0F);
  EXPECT_EQ(score(kernel, cloud.spans(), {}), std::vector<float>{0.0F});
  EXPECT_NEAR(score(kernel, cloud.spans(), fan(3).points())[0], -6.0, 1e-6);
}

TEST(LikelihoodField, IsAGaussianWithAFloor) {
  Grid<float> distance(3, 1);
  distance.at({1, 0}) = 2.0F;
  distance.at({2, 0}) = std::numeric_limits<float>::infinity();
  const Grid<float> field = likelihood_field(distance, {.sigma_px = 2.0, .floor = 0.25});
  EXPECT_NEAR(field.at({0, 0}), 0.0, 1e-7);
  EXPECT_NEAR(field.at({1, 0}), std::log(0.75 * std::exp(-0.5) + 0.25), 1e-6);
  EXPECT_NEAR(field.at({2, 0}), std::log(0.25), 1e-6);
  EXPECT_THROW(likelihood_field(distance, {.sigma_px = 0.0}), std::invalid_argument);
  EXPECT_THROW(likelihood_field(distance, {.floor = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
