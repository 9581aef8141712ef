#include "apps/read_bytes.hpp"

#include <fstream>
#include <stdexcept>

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

std::string bytes_of(const std::filesystem::path& file) {
  std::optional<std::string> bytes = read_bytes(file);
  if (!bytes) {
    throw std::runtime_error(file.string() + ": cannot be read");
  }
  return *std::move(bytes);
}

}  // namespace sketchloc
