#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

std::string content_of(const fs::path& file) {
  std::ostringstream content;
  content << std::ifstream(file).rdbuf();
  return content.str();
}

/// The keys of papers in a text, such as Thrun05 in "[Thrun05 5.4]".
std::set<std::string> keys_in(const std::string& text) {
  static const std::regex citation(R"re(\[([A-Z][A-Za-z]+[0-9][0-9])[ \]])re");
  std::set<std::string> keys;
  for (std::sregex_iterator it(text.begin(), text.end(), citation), end; it != end; ++it) {
    keys.insert((*it)[1]);
  }
  return keys;
}

TEST(References, FindKeysWithAndWithoutASection) {
  EXPECT_THAT(keys_in("[Thrun05 5.4], [Chen20]; list[Index0], [0, 1]"),
              ::testing::ElementsAre("Chen20", "Thrun05"));
}

TEST(References, ListEveryPaperThatAHeaderOrSourceCites) {
  const fs::path root = SKETCHLOC_SOURCE_DIR;
  const std::set<std::string> listed = keys_in(content_of(root / "docs/references.md"));
  for (const char* folder : {"motion", "datasets", "registration", "filter", "eval", "apps"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      const fs::path extension = entry.path().extension();
      if (extension != ".hpp" && extension != ".cpp") {
        continue;
      }
      for (const std::string& key : keys_in(content_of(entry.path()))) {
        EXPECT_TRUE(listed.contains(key)) << entry.path() << " cites " << key;
      }
    }
  }
}

}  // namespace
}  // namespace sketchloc
