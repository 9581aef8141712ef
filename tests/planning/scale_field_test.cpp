#include "planning/scale_field.hpp"

#include <gtest/gtest.h>

#include <array>

namespace sketchloc {
namespace {

TEST(ScaleField, IsTheSameEverywhereWithoutSamples) {
  const ScaleField field(17.0);
  EXPECT_EQ(field.px_per_m({0.0, 0.0}), 17.0);
  EXPECT_EQ(field.px_per_m({-1e6, 1e6}), 17.0);
}

TEST(ScaleField, TellsNearASampleWhatItTellsAndFarAwayTheMean) {
  const std::array<ScaleSample, 2> samples = {{{{100.0, 100.0}, 10.0}, {{900.0, 100.0}, 40.0}}};
  const ScaleField field(1000, 600, samples, {.reach_px = 50.0, .mean_weight = 0.01});
  EXPECT_NEAR(field.px_per_m({100.0, 100.0}), 10.0, 0.3);
  EXPECT_NEAR(field.px_per_m({900.0, 100.0}), 40.0, 1.2);
  EXPECT_NEAR(field.px_per_m({500.0, 590.0}), 20.0, 0.1);  // of log scales
}

TEST(ScaleField, GoesOnBeyondTheDrawing) {
  const std::array<ScaleSample, 1> samples = {{{{10.0, 10.0}, 12.0}}};
  const ScaleField field(50, 50, samples);
  EXPECT_NEAR(field.px_per_m({-500.0, 20.0}), 12.0, 1e-4);
}

TEST(ScaleField, OfAllPixelsIsWhatItIsOneByOne) {
  const std::array<ScaleSample, 3> samples = {
      {{{10.0, 12.0}, 10.0}, {{70.0, 20.0}, 40.0}, {{40.0, 45.0}, 15.0}}};
  for (const ScaleField& field :
       {ScaleField(93, 51, samples, {.reach_px = 15.0, .mean_weight = 0.05}), ScaleField(17.0)}) {
    const Grid<float> all = field.m_per_px(93, 51);
    for (int row = 0; row < 51; ++row) {
      for (int column = 0; column < 93; ++column) {
        const double one = 1.0 / field.px_per_m(centre_of({column, row}));
        ASSERT_NEAR(static_cast<double>(all.at({column, row})), one, 1e-6 * one);
      }
    }
  }
}

TEST(ScaleField, RefusesParametersOutOfRange) {
  EXPECT_THROW(validate(ScaleFieldParams{.reach_px = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(ScaleFieldParams{.mean_weight = 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
