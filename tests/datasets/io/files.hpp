#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "tests/support/shared_data.hpp"

namespace sketchloc::testing {

/// A fresh folder for every test, with files made on the spot.
class FileTest : public ::testing::Test {
 protected:
  std::filesystem::path file(std::string_view name, std::string_view content) const;
  std::filesystem::path gzip_file(std::string_view name, std::string_view content) const;
  std::filesystem::path missing(std::string_view name) const { return folder_ / name; }
  const std::filesystem::path& folder() const { return folder_.path(); }

 private:
  TemporaryDirectory folder_;
};

std::string content_of(const std::filesystem::path& file);

/// EXPECT_THAT(call, FailsWith("run.log:3: odom_x: expected ..."))
template <typename Matcher>
auto FailsWith(Matcher message) {
  return ::testing::ThrowsMessage<std::runtime_error>(message);
}
inline auto FailsWith(const char* part) {
  return ::testing::ThrowsMessage<std::runtime_error>(::testing::HasSubstr(part));
}

}  // namespace sketchloc::testing
