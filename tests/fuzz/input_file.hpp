#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace sketchloc::fuzz {

/// Bytes as a file in memory, for readers that want a path.
class InputFile {
 public:
  explicit InputFile(std::span<const std::uint8_t> bytes);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  int descriptor_;
  std::filesystem::path path_;
};

/// An empty folder, removed with the object.
class InputFolder {
 public:
  InputFolder();
  ~InputFolder();
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Aborts if a reader gave back something that it promises not to.
void require(bool holds, const char* what);

}  // namespace sketchloc::fuzz
