#include "motion/number_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace sketchloc {
namespace {

TEST(NumberText, IsTheShortestThatReadsBackTheSame) {
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(0.1F), "0.1");
  EXPECT_EQ(number_text(std::nextafter(1.0, 2.0)), "1.0000000000000002");
  EXPECT_EQ(number_text(100'000), "100000");
  for (const double number : {0.1 + 0.2, 1e-300, -2.5e17}) {
    EXPECT_EQ(parse_number<double>(number_text(number)), number);
  }
}

TEST(ParseNumber, TakesWholeTextsOnly) {
  EXPECT_EQ(parse_number<double>("+1.5"), 1.5);
  EXPECT_EQ(parse_number<std::int64_t>("-7"), -7);
  EXPECT_TRUE(std::isnan(parse_number<double>("nan").value()));
  for (const char* text : {"", "+", "+-1", "1 ", " 1", "1,5", "1.5x", "0x10"}) {
    EXPECT_FALSE(parse_number<double>(text)) << text;
  }
}

TEST(ParseNumber, RefusesWhatDoesNotFitTheType) {
  EXPECT_FALSE(parse_number<std::int8_t>("128"));
  EXPECT_FALSE(parse_number<std::uint64_t>("-1"));
  EXPECT_FALSE(parse_number<std::int64_t>("1.5"));
  EXPECT_FALSE(parse_number<double>("1e999"));
}

}  // namespace
}  // namespace sketchloc
