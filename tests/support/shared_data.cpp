#include "tests/support/shared_data.hpp"

#include <unistd.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace sketchloc::testing {

std::optional<std::filesystem::path> shared_data(const std::filesystem::path& relative) {
  const char* root = std::getenv("SKETCHLOC_DATA");
  const std::filesystem::path folder =
      root != nullptr ? std::filesystem::path(root)
                      : std::filesystem::path(SKETCHLOC_SOURCE_DIR) / ".." / "shared" / "data";
  const std::filesystem::path file = folder / relative;
  if (!std::filesystem::exists(file)) {
    return std::nullopt;
  }
  return file;
}

TemporaryDirectory::TemporaryDirectory() {
  std::string pattern = (std::filesystem::temp_directory_path() / "sketchloc-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) {
    throw std::runtime_error("cannot make a temporary directory like " + pattern);
  }
  path_ = pattern;
}

TemporaryDirectory::~TemporaryDirectory() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace sketchloc::testing
