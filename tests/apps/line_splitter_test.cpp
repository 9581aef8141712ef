#include "apps/line_splitter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sketchloc {
namespace {

using ::testing::ElementsAre;

/// Lines of a text that comes in parts of this many bytes; "..." for one that is too long.
std::vector<std::string> lines_of(const std::string& text, std::size_t part, std::size_t longest) {
  LineSplitter splitter(longest);
  std::vector<std::string> lines;
  const auto take = [&](const LineSplitter::Line& line) {
    lines.push_back(line.too_long ? "..." : line.text);
  };
  for (std::size_t i = 0; i < text.size(); i += part) {
    splitter.feed(std::string_view(text).substr(i, part), take);
  }
  if (const auto rest = splitter.rest()) {
    take(*rest);
  }
  return lines;
}

TEST(LineSplitter, FindsLinesHoweverTheyCome) {
  for (const std::size_t part : {1U, 2U, 3U, 100U}) {
    EXPECT_THAT(lines_of("one\n\ntwo\r\nthree", part, 10), ElementsAre("one", "", "two", "three"));
    EXPECT_THAT(lines_of("one\n", part, 10), ElementsAre("one"));
  }
}

TEST(LineSplitter, LeavesOutLinesThatAreTooLong) {
  for (const std::size_t part : {1U, 4U, 100U}) {
    EXPECT_THAT(lines_of("123456\nok\n1234567890", part, 5), ElementsAre("...", "ok", "..."));
  }
}

}  // namespace
}  // namespace sketchloc
