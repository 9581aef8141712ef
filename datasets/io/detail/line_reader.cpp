#include "datasets/io/detail/line_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

namespace sketchloc::detail {
namespace {

constexpr std::size_t kFirstBufferBytes = std::size_t{64} << 10;

}  // namespace

LineReader::LineReader(const std::filesystem::path& file, const TextLimits& limits)
    : file_(gzopen(file.c_str(), "rb")),
      limits_(limits),
      place_{.file = file, .line = 0},
      buffer_(kFirstBufferBytes) {
  if (!file_) {
    fail(place_, std::string("cannot be opened: ") + std::strerror(errno));
  }
}

std::optional<std::string_view> LineReader::next() {
  const std::optional<Span> line = find_line();
  if (!line) {
    return std::nullopt;
  }
  ++place_.line;
  line_was_ended_ = line->ended;
  const std::string_view text = text_of(*line);
  begin_ += line->length;
  return text;
}

std::optional<std::string_view> LineReader::peek() {
  const std::optional<Span> line = find_line();
  return line ? std::optional(text_of(*line)) : std::nullopt;
}

std::string_view LineReader::text_of(const Span& line) const {
  std::string_view text(buffer_.data() + begin_, line.length - (line.ended ? 1 : 0));
  if (text.ends_with('\r')) {
    text.remove_suffix(1);
  }
  return text;
}

std::optional<LineReader::Span> LineReader::find_line() {
  std::size_t searched = begin_;
  while (true) {
    const void* found = std::memchr(buffer_.data() + searched, '\n', end_ - searched);
    if (found != nullptr) {
      const auto newline =
          static_cast<std::size_t>(static_cast<const char*>(found) - buffer_.data());
      return Span{.length = newline + 1 - begin_, .ended = true};
    }
    const std::size_t unended = end_ - begin_;
    if (unended > limits_.line_bytes) {
      fail({place_.file, place_.line + 1}, "line: expected at most " +
                                               std::to_string(limits_.line_bytes) +
                                               " bytes, found more; is this a text log?");
    }
    if (!read_more()) {
      return unended > 0 ? std::optional(Span{.length = unended, .ended = false}) : std::nullopt;
    }
    searched = begin_ + unended;
  }
}

void LineReader::expect_whole() const {
  if (cut_off_) {
    fail(place_, "the gzip stream ends early, at this line; copy the file again");
  }
}

/// Appends to the buffer; false at the end of the file.
bool LineReader::read_more() {
  if (finished_) {
    return false;
  }
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (end_ == buffer_.size()) {
    buffer_.resize(buffer_.size() * 2);
  }
  const int count =
      gzread(file_.get(), buffer_.data() + end_, static_cast<unsigned>(buffer_.size() - end_));
  int status = Z_OK;
  const char* reason = gzerror(file_.get(), &status);
  if (count < 0 && status != Z_BUF_ERROR) {
    fail({place_.file, place_.line + 1},
         std::string("cannot be read: ") + (status == Z_ERRNO ? std::strerror(errno) : reason));
  }
  if (count <= 0) {
    finished_ = true;
    cut_off_ = status == Z_BUF_ERROR;
    return false;
  }
  end_ += static_cast<std::size_t>(count);
  total_bytes_ += static_cast<std::uint64_t>(count);
  if (total_bytes_ > limits_.total_bytes) {
    fail({place_.file, place_.line + 1}, "text: expected at most " +
                                             std::to_string(limits_.total_bytes) +
                                             " bytes after unpacking, found more; split the file");
  }
  return true;
}

void for_each_data_line(const std::filesystem::path& file, const TakeLine& take,
                        const TakeLine& take_comment) {
  LineReader lines(file);
  while (const std::optional<std::string_view> line = lines.next()) {
    const std::size_t start = line->find_first_not_of(" \t");
    if (start == std::string_view::npos) {
      continue;
    }
    if ((*line)[start] != '#') {
      take(*line, lines.place());
    } else if (take_comment) {
      take_comment(*line, lines.place());
    }
  }
  lines.expect_whole();
}

}  // namespace sketchloc::detail
