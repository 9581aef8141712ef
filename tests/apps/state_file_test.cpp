#include "apps/state_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>
#include <string>

#include "tests/support/run_command.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using testing::content_of;
using ::testing::HasSubstr;
using testing::TemporaryDirectory;

constexpr const char* kWhat = "drawing: 10 x 10 px\nseed: 1\n";

std::string complaint_about(const std::string& bytes, const std::string& what = kWhat) {
  try {
    state_in(bytes, what, "kept.state");
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(StateFile, GivesBackWhatWasKept) {
  const std::string state("\0\1\n\xff", 4);
  EXPECT_EQ(state_in(state_file_bytes(kWhat, state), kWhat, "kept.state"), state);
}

TEST(StateFile, IsRefusedWhereItIsOfSomethingElse) {
  EXPECT_THAT(complaint_about(state_file_bytes(kWhat, "x"), "drawing: 10 x 10 px\nseed: 2\n"),
              HasSubstr("kept.state: is of another run: it was kept with `seed: 1`, now there is "
                        "`seed: 2`"));
}

TEST(StateFile, IsRefusedWhereAnythingIsDamaged) {
  const std::string whole = state_file_bytes(kWhat, "some state");
  EXPECT_THAT(complaint_about("hello"), HasSubstr("is no state"));
  EXPECT_THAT(complaint_about(""), HasSubstr("is no state"));
  for (std::size_t length = 16; length < whole.size(); ++length) {
    EXPECT_THAT(complaint_about(whole.substr(0, length)), HasSubstr("kept.state: ")) << length;
  }
  for (std::size_t i = 16; i < whole.size(); ++i) {
    std::string wrong = whole;
    wrong[i] = static_cast<char>(wrong[i] ^ 0x10);
    EXPECT_THAT(complaint_about(wrong), HasSubstr("kept.state: ")) << "byte " << i;
  }
  std::string other_version = whole;
  other_version[16] = 99;
  EXPECT_THAT(complaint_about(other_version), HasSubstr("is a state of version 99"));
  EXPECT_THAT(complaint_about(whole + "x"), HasSubstr("is damaged"));
}

TEST(StateKeeper, KeepsTheLastState) {
  const TemporaryDirectory folder;
  StateKeeper keeper(folder / "kept.state", kWhat);
  keeper.keep("one");
  keeper.keep("two");
  keeper.flush();
  EXPECT_EQ(state_in(content_of(folder / "kept.state"), kWhat, "kept.state"), "two");
  EXPECT_GE(keeper.written(), 1U);
  EXPECT_FALSE(keeper.complaint());
}

TEST(StateKeeper, SaysWhatWentWrongAndGoesOn) {
  const TemporaryDirectory folder;
  StateKeeper keeper(folder / "missing/kept.state", kWhat);
  keeper.keep("one");
  keeper.flush();
  EXPECT_THAT(keeper.complaint().value_or(""), HasSubstr("missing/kept.state"));
  EXPECT_FALSE(keeper.complaint());
  std::filesystem::create_directory(folder / "missing");
  keeper.keep("two");
  keeper.flush();
  EXPECT_EQ(keeper.written(), 1U);
}

}  // namespace
}  // namespace sketchloc
