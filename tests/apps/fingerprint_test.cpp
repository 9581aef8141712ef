#include "apps/fingerprint.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

std::string of_text(const std::string& text) { return fingerprint(std::as_bytes(std::span(text))); }

TEST(Fingerprint, ChangesWithEveryByte) {
  const std::string text = "0123456789abcdef+";
  const std::string before = of_text(text);
  EXPECT_EQ(before.size(), 16U);
  EXPECT_EQ(before, of_text(text));
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string other = text;
    other[i] = static_cast<char>(other[i] ^ 1);
    EXPECT_NE(of_text(other), before) << i;
  }
}

TEST(Fingerprint, KnowsZerosAtTheEnd) {
  EXPECT_NE(of_text(std::string(7, '\0')), of_text(std::string(8, '\0')));
  EXPECT_NE(of_text(""), of_text(std::string(1, '\0')));
}

TEST(Fingerprint, OfAFileIsThatOfItsContentWhateverItsTime) {
  const testing::TemporaryDirectory folder;
  const auto file = folder / "a.png";
  std::ofstream(file) << "one";
  const auto time = std::filesystem::last_write_time(file);
  EXPECT_EQ(fingerprint_of_file(file), of_text("one"));
  std::ofstream(file) << "two";
  std::filesystem::last_write_time(file, time);
  EXPECT_EQ(fingerprint_of_file(file), of_text("two"));
  EXPECT_EQ(fingerprint_of_file(folder / "b.png"), "none");
}

}  // namespace
}  // namespace sketchloc
