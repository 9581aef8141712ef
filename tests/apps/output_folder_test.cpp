#include "apps/output_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <stdexcept>

#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class OutputFolderTest : public ::testing::Test {
 protected:
  void make_result(const std::string& content) const {
    OutputFolder output(target_, true);
    std::ofstream(output / "run.yaml") << content;
    output.commit();
  }
  std::string result() const {
    std::string word;
    std::ifstream(target_ / "run.yaml") >> word;
    return word;
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()));
  }

  testing::TemporaryDirectory folder_;
  const fs::path target_ = folder_ / "result";
};

TEST_F(OutputFolderTest, AppearsWholeOnCommit) {
  OutputFolder output(target_, false);
  std::ofstream(output / "run.yaml") << "first";
  EXPECT_FALSE(fs::exists(target_));
  output.commit();
  EXPECT_EQ(result(), "first");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(OutputFolderTest, NeedsAName) {
  EXPECT_THROW(OutputFolder("", false), std::invalid_argument);
}

TEST_F(OutputFolderTest, LeavesNothingWithoutCommit) {
  {
    const OutputFolder output(target_, false);
    std::ofstream(output / "run.yaml") << "first";
  }
  EXPECT_EQ(entries(), 0u);
}

TEST_F(OutputFolderTest, RefusesAnEarlierResultWithoutForce) {
  make_result("first");
  EXPECT_THROW(OutputFolder(target_, false), std::invalid_argument);
  EXPECT_EQ(result(), "first");
  EXPECT_EQ(entries(), 1u);
}

TEST_F(OutputFolderTest, ReplacesAnEarlierResultWithForce) {
  make_result("first");
  std::ofstream(target_ / "old.txt") << "old";
  make_result("second");
  EXPECT_EQ(result(), "second");
  EXPECT_FALSE(fs::exists(target_ / "old.txt"));
  EXPECT_EQ(entries(), 1u);
}

TEST_F(OutputFolderTest, NeverReplacesAFolderThatIsNoResult) {
  fs::create_directory(target_);
  std::ofstream(target_ / "thesis.tex") << "dear";
  EXPECT_THROW(OutputFolder(target_, true), std::invalid_argument);
  EXPECT_TRUE(fs::exists(target_ / "thesis.tex"));
}

TEST_F(OutputFolderTest, NeverReplacesAFile) {
  std::ofstream(target_) << "a file";
  EXPECT_THROW(OutputFolder(target_, false), std::invalid_argument);
  EXPECT_THROW(OutputFolder(target_, true), std::invalid_argument);
}

TEST_F(OutputFolderTest, TakesAnEmptyFolder) {
  fs::create_directory(target_);
  OutputFolder output(target_, false);
  output.commit();
  EXPECT_TRUE(fs::is_directory(target_));
}

TEST_F(OutputFolderTest, MakesTheFoldersAboveAndTakesATrailingSlash) {
  OutputFolder output(folder_ / "a/b/c/", false);
  output.commit();
  EXPECT_TRUE(fs::is_directory(folder_ / "a/b/c"));
}

TEST_F(OutputFolderTest, ReplacesTheFolderThatALinkPointsTo) {
  make_result("first");
  const fs::path link = folder_ / "link";
  fs::create_directory_symlink(target_, link);
  OutputFolder output(link, true);
  std::ofstream(output / "run.yaml") << "second";
  output.commit();
  EXPECT_EQ(result(), "second");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(entries(), 2U);
}

/// What commit() says where it fails.
std::string commit_error(OutputFolder& output) {
  try {
    output.commit();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(OutputFolderTest, KeepsTheNewResultWhereItsNameIsTakenMeanwhile) {
  fs::path staging;
  {
    OutputFolder output(target_, false);
    staging = (output / "run.yaml").parent_path();
    std::ofstream(output / "run.yaml") << "new";
    std::ofstream(target_) << "a file";
    EXPECT_THAT(commit_error(output), HasSubstr("they are whole in " + staging.string()));
  }
  EXPECT_TRUE(fs::is_regular_file(target_));
  EXPECT_TRUE(fs::exists(staging / "run.yaml"));
  EXPECT_EQ(entries(), 2U);
}

TEST_F(OutputFolderTest, PutsTheEarlierResultBackWhereTheNewOneIsGone) {
  make_result("first");
  OutputFolder output(target_, true);
  fs::remove_all((output / "run.yaml").parent_path());
  EXPECT_THAT(commit_error(output), HasSubstr("cannot take the name"));
  EXPECT_EQ(result(), "first");
  EXPECT_EQ(entries(), 1U);
}

TEST_F(OutputFolderTest, IsReadableLikeAnyOtherFolder) {
  const mode_t before = ::umask(0027);
  OutputFolder(target_, false).commit();
  fs::create_directory(folder_ / "other");
  EXPECT_EQ(fs::status(target_).permissions(), fs::status(folder_ / "other").permissions());
  EXPECT_EQ(fs::status(target_).permissions(), fs::perms(0750));
  ::umask(before);
}

}  // namespace
}  // namespace sketchloc
