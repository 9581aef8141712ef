#include "tests/fuzz/input_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>

namespace sketchloc::fuzz {

InputFile::InputFile(std::span<const std::uint8_t> bytes)
    : descriptor_(::memfd_create("fuzz", 0)),
      path_("/proc/self/fd/" + std::to_string(descriptor_)) {
  const auto size = static_cast<ssize_t>(bytes.size());
  require(descriptor_ >= 0 && ::write(descriptor_, bytes.data(), bytes.size()) == size,
          "a file in memory");
}

InputFile::~InputFile() { ::close(descriptor_); }

InputFolder::InputFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "fuzz-XXXXXX").string();
  require(::mkdtemp(pattern.data()) != nullptr, "a temporary folder");
  path_ = pattern;
}

InputFolder::~InputFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

void require(bool holds, const char* what) {
  if (!holds) {
    std::fprintf(stderr, "does not hold: %s\n", what);
    std::abort();
  }
}

}  // namespace sketchloc::fuzz
