#include "datasets/io/atomic_file.hpp"

#include <sys/stat.h>

#include <string>
#include <thread>
#include <vector>

#include "tests/datasets/io/files.hpp"

namespace sketchloc {
namespace {

using testing::content_of;
using testing::FailsWith;

class WriteAtomically : public testing::FileTest {
 protected:
  std::size_t files_in_folder() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder()), {}));
  }
};

TEST_F(WriteAtomically, WritesANewFileThatOthersMayRead) {
  const std::string content("a\0b\n", 4);
  write_atomically(missing("new.txt"), content);
  EXPECT_EQ(content_of(missing("new.txt")), content);
  EXPECT_EQ(files_in_folder(), 1U);
  const auto mode = std::filesystem::status(missing("new.txt")).permissions();
  EXPECT_NE(mode & std::filesystem::perms::owner_read, std::filesystem::perms::none);
  EXPECT_EQ(mode & std::filesystem::perms::owner_exec, std::filesystem::perms::none);
}

TEST_F(WriteAtomically, ReplacesAFileAndKeepsItsMode) {
  const std::filesystem::path path = file("old.txt", "old");
  std::filesystem::permissions(path, std::filesystem::perms(0640));
  write_atomically(path, "new");
  EXPECT_EQ(content_of(path), "new");
  EXPECT_EQ(std::filesystem::status(path).permissions(), std::filesystem::perms(0640));
}

TEST_F(WriteAtomically, KeepsToTheMaskOfTheUserOnEveryThread) {
  const mode_t before = ::umask(0077);
  {
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < 4; ++thread) {
      threads.emplace_back([this, thread] {
        for (int i = 0; i < 50; ++i) {
          write_atomically(missing(std::to_string(thread) + "-" + std::to_string(i)), "x");
        }
      });
    }
  }
  EXPECT_EQ(::umask(before), 0077U);
  EXPECT_EQ(files_in_folder(), 200U);
  for (const auto& entry : std::filesystem::directory_iterator(folder())) {
    EXPECT_EQ(entry.status().permissions(), std::filesystem::perms(0600)) << entry.path();
  }
}

TEST_F(WriteAtomically, SaysPathAndReasonWhereTheFolderIsMissing) {
  EXPECT_THAT(
      [&] { write_atomically(missing("no/such/file.txt"), "x"); },
      FailsWith(::testing::AllOf(::testing::HasSubstr("no/such/file.txt: cannot be written"),
                                 ::testing::HasSubstr("No such file"))));
}

TEST_F(WriteAtomically, LeavesNothingBehindWhenItFails) {
  std::filesystem::create_directory(missing("folder"));
  EXPECT_THAT([&] { write_atomically(missing("folder"), "x"); }, FailsWith("renaming"));
  EXPECT_EQ(files_in_folder(), 1U);
}

}  // namespace
}  // namespace sketchloc
