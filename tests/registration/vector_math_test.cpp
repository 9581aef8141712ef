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

std::vector<float> many_exponents() {
  std::vector<float> exponents;
  for (int i = -8000; i <= 8000; ++i) {
    exponents.push_back(0.01F * static_cast<float>(i));
  }
  return exponents;
}

TEST(Exponentials, AreThoseOfTheirExponents) {
  const std::vector<float> exponents = many_exponents();
  std::vector<float> exponentials_of(exponents.size());
  exponentials(exponents, exponentials_of);
  for (std::size_t i = 0; i < exponents.size(); ++i) {
    const double expected = std::exp(static_cast<double>(exponents[i]));
    ASSERT_NEAR(exponentials_of[i] / expected, 1.0, 2e-7) << exponents[i];
  }
  std::vector<float> extreme = {1e9F, -1e9F};
  exponentials(extreme, extreme);
  EXPECT_TRUE(std::isfinite(extreme[0]));
  EXPECT_GT(extreme[1], 0.0F);
}

struct Vectors {
  std::vector<float> x;
  std::vector<float> y;
};

Vectors many_vectors() {
  Vectors vectors{{0.0F, 0.0F, -1.0F, 1.0F, -3.0F}, {0.0F, -2.0F, 0.0F, 1.0F, -3.0F}};
  for (int i = 0; i < 3000; ++i) {
    const float turn = 0.0037F * static_cast<float>(i) - 5.0F;
    const float length = std::exp(0.01F * static_cast<float>(i) - 15.0F);
    vectors.x.push_back(length * std::cos(turn));
    vectors.y.push_back(length * std::sin(turn));
  }
  return vectors;
}

TEST(Angles, AreThoseOfTheVectors) {
  const Vectors vectors = many_vectors();
  std::vector<float> angles_of(vectors.x.size());
  angles(vectors.x, vectors.y, angles_of);
  for (std::size_t i = 0; i < angles_of.size(); ++i) {
    ASSERT_NEAR(angles_of[i], std::atan2(vectors.y[i], vectors.x[i]), 1e-6) << i;
  }
}

TEST(ExponentialsAndAngles, AreTheSameBitsWithEveryInstructionSet) {
  const std::vector<float> exponents = many_exponents();
  const Vectors vectors = many_vectors();
  std::vector<float> exponentials_of(exponents.size());
  std::vector<float> angles_of(vectors.x.size());
  exponentials(exponents, exponentials_of);
  angles(vectors.x, vectors.y, angles_of);
  for (const std::int64_t target : vector_targets()) {
    const OnlyTarget only(target);
    std::vector<float> other_exponentials(exponents.size());
    std::vector<float> other_angles(vectors.x.size());
    exponentials(exponents, other_exponentials);
    angles(vectors.x, vectors.y, other_angles);
    EXPECT_EQ(exponentials_of, other_exponentials) << hwy::TargetName(target);
    EXPECT_EQ(angles_of, other_angles) << hwy::TargetName(target);
  }
}

}  // namespace
}  // namespace sketchloc
