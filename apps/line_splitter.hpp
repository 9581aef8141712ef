#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace sketchloc {

/// Cuts a stream of bytes into lines, in bounded memory.
class LineSplitter {
 public:
  /// A line without its end ("\n" or "\r\n"); of one that is too long nothing.
  struct Line {
    std::string text;
    bool too_long = false;
  };

  explicit LineSplitter(std::size_t longest) : longest_(longest) {}

  /// Gives the lines that these bytes end.
  void feed(std::string_view bytes, const std::function<void(Line)>& take);

  /// What came after the last end of line, where the stream ends; none: nothing.
  std::optional<Line> rest();

 private:
  void append(std::string_view part);
  Line finished();

  std::size_t longest_;
  Line line_;
};

}  // namespace sketchloc
