#pragma once

#include <zlib.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "datasets/io/detail/place.hpp"

namespace sketchloc::detail {

/// What a reader of text takes at most, so that no input can eat the memory.
struct TextLimits {
  std::size_t line_bytes = std::size_t{4} << 20;       ///< longest line
  std::uint64_t total_bytes = std::uint64_t{1} << 30;  ///< whole text, after unpacking
};

/// The lines of a text file, plain or gzip (found by content), in bounded memory.
class LineReader {
 public:
  explicit LineReader(const std::filesystem::path& file, const TextLimits& limits = {});

  /// The next line without its end ("\n" or "\r\n"), valid until the next call; none at the end of
  /// the file. Throws on read errors and on lines beyond the limit. A text that is cut off inside
  /// its gzip stream ends at the cut, see cut_off().
  std::optional<std::string_view> next();
  /// The same line that next() will give.
  std::optional<std::string_view> peek();

  /// Where the last line given by next() stands.
  const Place& place() const { return place_; }
  /// True if the last line given by next() had its end of line.
  bool line_was_ended() const { return line_was_ended_; }
  /// True if the gzip stream stops before its end; known after the last line.
  bool cut_off() const { return cut_off_; }
  /// An error if it does.
  void expect_whole() const;

 private:
  struct Close {
    void operator()(gzFile_s* file) const { gzclose_r(file); }
  };
  struct Span {
    std::size_t length = 0;  ///< of the line with its end
    bool ended = false;
  };

  std::optional<Span> find_line();
  bool read_more();
  std::string_view text_of(const Span& line) const;

  std::unique_ptr<gzFile_s, Close> file_;
  TextLimits limits_;
  Place place_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;  ///< of what is read but not given yet
  std::size_t end_ = 0;
  std::uint64_t total_bytes_ = 0;
  bool finished_ = false;
  bool line_was_ended_ = true;
  bool cut_off_ = false;
};

using TakeLine = std::function<void(std::string_view line, const Place& place)>;

/// Gives the lines that are neither blank nor #-comments to `take`, comments to `take_comment`. A
/// gzip stream that ends early is an error.
void for_each_data_line(const std::filesystem::path& file, const TakeLine& take,
                        const TakeLine& take_comment = {});

}  // namespace sketchloc::detail
