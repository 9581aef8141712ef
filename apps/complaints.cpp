#include "apps/complaints.hpp"

namespace sketchloc {

std::optional<std::string> Complaints::about(const std::string& kind, const std::string& what,
                                             double now_s) {
  const auto [found, is_new] = kinds_.try_emplace(kind);
  Kind& known = found->second;
  if (!is_new && now_s - known.said_s < every_s_) {
    ++known.unsaid;
    return std::nullopt;
  }
  const std::string more =
      known.unsaid > 0 ? " (and " + std::to_string(known.unsaid) + " like it before)" : "";
  known = {.said_s = now_s, .unsaid = 0};
  return what + more;
}

}  // namespace sketchloc
