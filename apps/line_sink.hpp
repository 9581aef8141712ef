#pragma once

#include <filesystem>
#include <string_view>

#include "apps/descriptor.hpp"

namespace sketchloc {

/// Writes whole lines at once, so that whoever reads them waits for nothing.
class LineSink {
 public:
  enum class Existing { Refuse, Replace, Append };

  /// To stdout.
  LineSink();
  /// To a file. Throws std::invalid_argument where it is there and may not be, std::runtime_error
  /// where it cannot be written.
  LineSink(const std::filesystem::path& file, Existing existing);

  /// Adds the end of line. False: nobody reads any more, or the program was asked to end while
  /// nobody did. Throws std::runtime_error where the system refuses (a full disk).
  bool write(std::string_view line);

 private:
  std::filesystem::path name_;
  Descriptor own_;
  int descriptor_;
};

}  // namespace sketchloc
