#include "eval/detail/text.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace sketchloc::detail {
namespace {

TEST(Escaped, TurnsMarkupIntoText) {
  EXPECT_EQ(escaped("a<b> & \"c\" 'd'"), "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
}

TEST(Escaped, KeepsTextOfAllLanguages) { EXPECT_EQ(escaped("Küche 台所 🏠"), "Küche 台所 🏠"); }

TEST(Escaped, ReplacesControlCharactersAndBrokenUtf8) {
  const std::string replacement = "\xEF\xBF\xBD";
  EXPECT_EQ(escaped("a\x01z\n"), "a" + replacement + "z\n");
  EXPECT_EQ(escaped("a\xFFz"), "a" + replacement + "z");
  EXPECT_EQ(escaped("a\xC3"), "a" + replacement);                               // cut short
  EXPECT_EQ(escaped("\xC0\xAF"), replacement + replacement);                    // overlong
  EXPECT_EQ(escaped("\xED\xA0\x80"), replacement + replacement + replacement);  // surrogate
}

TEST(Fixed, RoundsAndNeverSaysMinusZero) {
  EXPECT_EQ(fixed(1.256, 2), "1.26");
  EXPECT_EQ(fixed(-0.001, 1), "0.0");
  EXPECT_EQ(fixed(-1.5, 1), "-1.5");
  EXPECT_EQ(fixed(std::numeric_limits<double>::quiet_NaN(), 1), "\xE2\x80\x93");
}

TEST(ShortNumber, DropsZerosAtTheEnd) {
  EXPECT_EQ(short_number(3.0), "3");
  EXPECT_EQ(short_number(0.5), "0.5");
  EXPECT_EQ(short_number(100.0), "100");
}

TEST(WithUnit, KeepsTheDigitsThatOneReads) {
  EXPECT_EQ(with_unit(0.834, "m"), "0.83\xC2\xA0m");
  EXPECT_EQ(with_unit(12.34, "m"), "12.3\xC2\xA0m");
  EXPECT_EQ(with_unit(148.2, "m"), "148\xC2\xA0m");
}

TEST(Duration, IsInMinutesWhereSecondsAreHardToRead) {
  EXPECT_EQ(duration(0.0), "0\xC2\xA0s");
  EXPECT_EQ(duration(2.34), "2.3\xC2\xA0s");
  EXPECT_EQ(duration(48.0), "48\xC2\xA0s");
  EXPECT_EQ(duration(311.7), "5\xC2\xA0min 12\xC2\xA0s");
  EXPECT_EQ(duration(179.9), "3\xC2\xA0min 0\xC2\xA0s");
}

TEST(Base64, MeetsTheExamplesOfRfc4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

}  // namespace
}  // namespace sketchloc::detail
