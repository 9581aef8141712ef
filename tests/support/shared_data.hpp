#pragma once

#include <filesystem>
#include <optional>

namespace sketchloc::testing {

/// A file of the development data ($SKETCHLOC_DATA, default ../shared/data beside the project);
/// none where it is absent, and then the test skips with SKIP_WITHOUT_SHARED_DATA.
std::optional<std::filesystem::path> shared_data(const std::filesystem::path& relative);

/// A new empty directory, removed with the object.
class TemporaryDirectory {
 public:
  TemporaryDirectory();
  ~TemporaryDirectory();
  TemporaryDirectory(const TemporaryDirectory&) = delete;
  TemporaryDirectory& operator=(const TemporaryDirectory&) = delete;
  std::filesystem::path operator/(const std::filesystem::path& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace sketchloc::testing
