#include "datasets/io/detail/gzip.hpp"

#include <zlib.h>

#include <limits>
#include <stdexcept>

namespace sketchloc::detail {

std::string gzipped(std::string_view content) {
  constexpr int kGzip = 16;  // added to the window's bits: a gzip header instead of zlib's
  constexpr int kMemoryLevel = 8;
  z_stream stream{};
  if (content.size() > std::numeric_limits<uInt>::max() / 2 ||
      deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, MAX_WBITS + kGzip, kMemoryLevel,
                   Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::runtime_error("a text of " + std::to_string(content.size()) +
                             " bytes cannot be packed; write it without .gz");
  }
  std::string packed(deflateBound(&stream, static_cast<uLong>(content.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(content.data()));  // only read
  stream.avail_in = static_cast<uInt>(content.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  const int status = deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) {
    throw std::runtime_error("the text cannot be packed; write it without .gz");
  }
  return packed;
}

}  // namespace sketchloc::detail
