#include "apps/config.hpp"

namespace sketchloc::detail {

void fail_to_read(const ConfigNode& node, std::string_view name, std::string_view expected) {
  throw std::invalid_argument(node.source + ": " + std::string(name) + " must be " +
                              std::string(expected) + ", but it is '" + node.text + "'");
}

void fail_to_validate(const ConfigNode& node, std::string_view name,
                      const std::invalid_argument& error) {
  const std::string_view what = error.what();
  const ConfigNode* field = node.find(what.substr(0, what.find(' ')));
  std::string message(field != nullptr ? field->source : node.source);
  message += message.empty() ? "" : ": ";
  message += name.empty() ? "" : std::string(name) + ".";
  throw std::invalid_argument(message + std::string(what));
}

}  // namespace sketchloc::detail
