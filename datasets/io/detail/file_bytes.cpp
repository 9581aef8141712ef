#include "datasets/io/detail/file_bytes.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include "datasets/io/detail/place.hpp"

namespace sketchloc::detail {

std::vector<unsigned char> read_bytes(const std::filesystem::path& file, std::size_t most_bytes) {
  std::ifstream in(file, std::ios::binary);
  if (!in) {
    fail({.file = file}, std::string("cannot be opened: ") + std::strerror(errno));
  }
  std::vector<unsigned char> bytes;
  std::vector<char> block(std::size_t{1} << 20);
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    bytes.insert(bytes.end(), block.begin(), block.begin() + in.gcount());
    if (bytes.size() > most_bytes) {
      fail({.file = file},
           "size: expected at most " + std::to_string(most_bytes) + " bytes, found more");
    }
  }
  if (bytes.empty()) {
    fail({.file = file}, "content: expected some, found an empty file or a folder");
  }
  return bytes;
}

}  // namespace sketchloc::detail
