#include "registration/vector_math.hpp"

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

std::vector<float> many_positive_numbers() {
  std::vector<float> numbers = {1.0F, 0.70710677F, 0.70710683F, 1.4142135F, 1e-37F, 3e38F};
  for (int i = -3000; i <= 3000; ++i) {
    numbers.push_back(std::exp(0.01F * static_cast<float>(i)));
  }
  return numbers;
}

TEST(Logarithms, AreNatural) {
  const std::vector<float> numbers = many_positive_numbers();
  std::vector<float> logs(numbers.size());
  logarithms(numbers, logs);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double expected = std::log(static_cast<double>(numbers[i]));
    ASSERT_NEAR(logs[i], expected, 2e-7 + 1.2e-7 * std::abs(expected)) << numbers[i];
  }
}

TEST(Logarithms, AreTheSameBitsWithEveryInstructionSet) {
  const std::vector<float> numbers = many_positive_numbers();
  std::vector<float> logs(numbers.size());
  logarithms(numbers, logs);
  for (const std::int64_t target : vector_targets()) {
    const OnlyTarget only(target);
    std::vector<float> other(numbers.size());
    logarithms(numbers, other);
    EXPECT_EQ(logs, other) << hwy::TargetName(target);
  }
}

}  // namespace
}  // namespace sketchloc
