#include "tests/datasets/io/files.hpp"

#include <zlib.h>

#include <fstream>
#include <iterator>

namespace sketchloc::testing {

std::filesystem::path FileTest::file(std::string_view name, std::string_view content) const {
  const std::filesystem::path path = folder_ / name;
  std::ofstream(path, std::ios::binary) << content;
  return path;
}

std::filesystem::path FileTest::gzip_file(std::string_view name, std::string_view content) const {
  const std::filesystem::path path = folder_ / name;
  gzFile out = gzopen(path.c_str(), "wb1");
  while (!content.empty()) {
    const std::string_view block = content.substr(0, std::size_t{1} << 20);
    gzwrite(out, block.data(), static_cast<unsigned>(block.size()));
    content.remove_prefix(block.size());
  }
  gzclose(out);
  return path;
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace sketchloc::testing
