#include "registration/unit_vectors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/vector_targets.hpp"

namespace sketchloc {
namespace {

using testing::OnlyTarget;
using testing::vector_targets;

std::vector<float> many_headings() {
  std::vector<float> headings;
  for (int i = -4001; i <= 4001; ++i) {
    headings.push_back(static_cast<float>(i) * 0.0031F);
  }
  for (const float special : {0.0F, -0.0F, 1.5707964F, 3.1415927F, -3.1415927F, 9999.0F, -1e4F}) {
    headings.push_back(special);
  }
  return headings;
}

TEST(UnitVectors, AreCosineAndSine) {
  const std::vector<float> headings = many_headings();
  std::vector<float> cosine(headings.size());
  std::vector<float> sine(headings.size());
  unit_vectors(headings, cosine, sine);
  for (std::size_t i = 0; i < headings.size(); ++i) {
    ASSERT_NEAR(cosine[i], std::cos(static_cast<double>(headings[i])), 2e-7) << headings[i];
    ASSERT_NEAR(sine[i], std::sin(static_cast<double>(headings[i])), 2e-7) << headings[i];
  }
}

TEST(UnitVectors, AreTheSameBitsWithEveryInstructionSet) {
  const std::vector<float> headings = many_headings();
  std::vector<float> cosine(headings.size());
  std::vector<float> sine(headings.size());
  unit_vectors(headings, cosine, sine);
  for (const std::int64_t target : vector_targets()) {
    const OnlyTarget only(target);
    std::vector<float> other_cosine(headings.size());
    std::vector<float> other_sine(headings.size());
    unit_vectors(headings, other_cosine, other_sine);
    EXPECT_EQ(cosine, other_cosine) << hwy::TargetName(target);
    EXPECT_EQ(sine, other_sine) << hwy::TargetName(target);
  }
}

}  // namespace
}  // namespace sketchloc
