#include "registration/correlation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "motion/random.hpp"

namespace sketchloc {
namespace {

std::vector<float> noise(int count, std::uint64_t seed) {
  Rng rng = make_rng(seed);
  std::vector<float> values;
  for (int i = 0; i < count; ++i) {
    values.push_back(static_cast<float>(gaussian(1.0, rng)));
  }
  return values;
}

/// The definition, word for word.
std::vector<double> plain_correlation(const FeatureShape& shape, const std::vector<float>& scan,
                                      const std::vector<float>& drawing) {
  const auto value = [&](const std::vector<float>& map, int channel, int y, int x) {
    const bool inside = y >= 0 && x >= 0 && y < shape.side && x < shape.side;
    const int index = (channel * shape.side + y) * shape.side + x;
    return inside ? static_cast<double>(map[static_cast<std::size_t>(index)]) : 0.0;
  };
  std::vector<double> result;
  for (int dy = -kCorrelationReach; dy <= kCorrelationReach; ++dy) {
    for (int dx = -kCorrelationReach; dx <= kCorrelationReach; ++dx) {
      for (int cell = 0; cell < shape.cells(); ++cell) {
        const int y = cell / shape.side;
        const int x = cell % shape.side;
        double sum = 0.0;
        for (int channel = 0; channel < shape.channels; ++channel) {
          sum += value(scan, channel, y, x) * value(drawing, channel, y + dy, x + dx);
        }
        result.push_back(sum / std::sqrt(shape.channels));
      }
    }
  }
  return result;
}

class CorrelationOf : public ::testing::TestWithParam<FeatureShape> {};

TEST_P(CorrelationOf, IsWhatItsDefinitionSays) {
  const FeatureShape shape = GetParam();
  const std::vector<float> scan = noise(shape.size(), 1);
  const std::vector<float> drawing = noise(shape.size(), 2);
  const std::vector<double> expected = plain_correlation(shape, scan, drawing);
  std::vector<float> result(expected.size());
  correlate(shape, scan, drawing, result);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(result[i], expected[i], 1e-5);
  }
}

/// The result is linear in each input, so a gradient is a sum over unit steps.
TEST_P(CorrelationOf, HasTheGradientsOfItsDefinition) {
  const FeatureShape shape = GetParam();
  const std::vector<float> scan = noise(shape.size(), 3);
  const std::vector<float> drawing = noise(shape.size(), 4);
  const std::vector<float> slope = noise(kCorrelationShifts * shape.cells(), 5);
  std::vector<float> to_scan(scan.size());
  std::vector<float> to_drawing(drawing.size());
  correlate_backwards(shape, scan, drawing, slope, to_scan, to_drawing);
  const auto loss = [&](const std::vector<float>& a, const std::vector<float>& b) {
    const std::vector<double> result = plain_correlation(shape, a, b);
    double sum = 0.0;
    for (std::size_t i = 0; i < result.size(); ++i) {
      sum += result[i] * static_cast<double>(slope[i]);
    }
    return sum;
  };
  for (std::size_t i = 0; i < scan.size(); i += 29) {
    std::vector<float> unit(scan.size(), 0.0F);
    unit[i] = 1.0F;
    EXPECT_NEAR(to_scan[i], loss(unit, drawing), 1e-4);
    EXPECT_NEAR(to_drawing[i], loss(scan, unit), 1e-4);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, CorrelationOf,
                         ::testing::Values(FeatureShape{.channels = 1, .side = 8},
                                           FeatureShape{.channels = 5, .side = 8},
                                           FeatureShape{.channels = 3, .side = 16}));

TEST(CorrelationDeathTest, RefusesBuffersOfOtherSizes) {
  std::vector<float> features(64);
  std::vector<float> result(10);
  EXPECT_DEATH(correlate({.channels = 1, .side = 8}, features, features, result), "shift");
}

}  // namespace
}  // namespace sketchloc
