#include "apps/unfinished_work.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;
using testing::TemporaryDirectory;

TEST(UnfinishedWork, KeepsPiecesForTheSameWork) {
  const TemporaryDirectory folder;
  {
    UnfinishedWork work(folder / "out", "parameters");
    EXPECT_FALSE(work.find("a/b, 1").has_value());
    work.keep("a/b, 1", "piece");
  }
  UnfinishedWork again(folder / "out/", "parameters");
  EXPECT_EQ(again.find("a/b, 1"), "piece");
  EXPECT_FALSE(again.find("a/b, 2").has_value());
  again.finish();
  EXPECT_FALSE(fs::exists(folder / "out.unfinished"));
}

TEST(UnfinishedWork, RefusesPiecesOfOtherWork) {
  const TemporaryDirectory folder;
  UnfinishedWork(folder / "out", "parameters").keep("a", "piece");
  EXPECT_THROW(UnfinishedWork(folder / "out", "others"), std::invalid_argument);
  EXPECT_EQ(UnfinishedWork(folder / "out", "parameters").find("a"), "piece");
}

}  // namespace
}  // namespace sketchloc
