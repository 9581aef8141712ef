#include "apps/read_bytes.hpp"

#include <fstream>

namespace sketchloc {

std::optional<std::string> read_bytes(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::is_regular_file(file, error)
                                  ? std::filesystem::file_size(file, error)
                                  : static_cast<std::uintmax_t>(-1);
  std::ifstream stream(file, std::ios::binary);
  if (error || size == static_cast<std::uintmax_t>(-1) || !stream) {
    return std::nullopt;
  }
  std::string bytes(size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  return stream ? std::optional(std::move(bytes)) : std::nullopt;
}

}  // namespace sketchloc
