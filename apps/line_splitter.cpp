#include "apps/line_splitter.hpp"

#include <utility>

namespace sketchloc {

void LineSplitter::append(std::string_view part) {
  if (line_.text.size() + part.size() > longest_) {
    line_.too_long = true;
    line_.text.clear();
  }
  if (!line_.too_long) {
    line_.text.append(part);
  }
}

LineSplitter::Line LineSplitter::finished() {
  if (line_.text.ends_with('\r')) {
    line_.text.pop_back();
  }
  return std::exchange(line_, {});
}

void LineSplitter::feed(std::string_view bytes, const std::function<void(Line)>& take) {
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    append(bytes.substr(0, end));
    if (end == std::string_view::npos) {
      return;
    }
    take(finished());
    bytes.remove_prefix(end + 1);
  }
}

std::optional<LineSplitter::Line> LineSplitter::rest() {
  const bool nothing = line_.text.empty() && !line_.too_long;
  return nothing ? std::nullopt : std::optional(finished());
}

}  // namespace sketchloc
