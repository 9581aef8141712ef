#include "motion/validate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace sketchloc {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <typename Action>
std::string error_of(const Action& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(Validate, NamesFieldRangeAndValue) {
  EXPECT_EQ(error_of([] { require_in_range("share", 1.5, 0.0, 1.0); }),
            "share must be in [0, 1], but it is 1.5");
  EXPECT_EQ(error_of([] { require_at_least("slip_m_per_m", -0.1, 0.0); }),
            "slip_m_per_m must be finite and at least 0, but it is -0.1");
  EXPECT_EQ(error_of([] { require_above("scale", 0.0, 0.0); }),
            "scale must be finite and above 0, but it is 0");
}

TEST(Validate, PrintsValuesThatAreNearlyInRangeWithAllTheirDigits) {
  EXPECT_EQ(error_of([] { require_in_range("share", std::nextafter(1.0, 2.0), 0.0, 1.0); }),
            "share must be in [0, 1], but it is 1.0000000000000002");
}

TEST(Validate, AcceptsTheEndsOfARange) {
  EXPECT_NO_THROW(require_in_range("share", 0.0, 0.0, 1.0));
  EXPECT_NO_THROW(require_in_range("share", 1.0, 0.0, 1.0));
  EXPECT_NO_THROW(require_at_least("slip_m_per_m", 0.0, 0.0));
  EXPECT_NO_THROW(require_above("scale", 1e-300, 0.0));
}

TEST(Validate, NeverAcceptsNanOrInfinity) {
  for (const double value : {kNan, kInfinity, -kInfinity}) {
    EXPECT_THROW(require_in_range("share", value, 0.0, 1.0), std::invalid_argument);
    EXPECT_THROW(require_at_least("slip_m_per_m", value, 0.0), std::invalid_argument);
    EXPECT_THROW(require_above("scale", value, 0.0), std::invalid_argument);
  }
}

}  // namespace
}  // namespace sketchloc
