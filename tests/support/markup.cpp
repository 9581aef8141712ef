#include "tests/support/markup.hpp"

#include <algorithm>
#include <cctype>

namespace sketchloc::testing {
namespace {

bool is_name(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-'; }

std::string_view without_leading(std::string_view text, bool (*drop)(char)) {
  while (!text.empty() && drop(text.front())) {
    text.remove_prefix(1);
  }
  return text;
}

/// ` name="value"` again and again.
bool are_attributes(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\n'; };
  for (text = without_leading(text, is_space); !text.empty();
       text = without_leading(text, is_space)) {
    const std::string_view rest = without_leading(text, is_name);
    const bool quoted = rest.size() < text.size() && rest.starts_with("=\"");
    const std::size_t end = quoted ? rest.find('"', 2) : std::string_view::npos;
    if (end == std::string_view::npos || rest.substr(0, end).find('<') != std::string_view::npos) {
      return false;
    }
    text = rest.substr(end + 1);
  }
  return true;
}

bool is_tag(std::string_view tag) {
  std::string_view inside = tag.substr(1, tag.size() - 2);
  if (inside.starts_with('/')) {
    inside.remove_prefix(1);
  } else if (inside.ends_with('/')) {
    inside.remove_suffix(1);
  }
  const std::string_view attributes = without_leading(inside, is_name);
  return attributes.size() < inside.size() && are_attributes(attributes);
}

bool is_entity(std::string_view text) {
  const std::size_t end = text.find(';');
  std::string_view name = text.substr(1, end == std::string_view::npos ? 0 : end - 1);
  if (name.starts_with('#')) {
    name.remove_prefix(1);
  }
  return !name.empty() && std::ranges::all_of(name, is_name);
}

std::string name_of(std::string_view tag) {
  const std::size_t first = tag.starts_with("</") ? 2 : 1;
  return std::string(tag.substr(first, tag.find_first_of(" \n/>", first) - first));
}

void check_entities(std::string_view text, std::vector<std::string>& faults) {
  for (std::size_t at = text.find('&'); at != std::string_view::npos; at = text.find('&', at + 1)) {
    if (!is_entity(text.substr(at, 12))) {
      faults.push_back("bare & in: " + std::string(text.substr(at, 12)));
    }
  }
}

void check_tag(const std::string& tag, std::vector<std::string>& open,
               std::vector<std::string>& faults) {
  if (!is_tag(tag)) {
    faults.push_back("malformed tag: " + tag);
  }
  if (tag.ends_with("/>")) {
    return;
  }
  if (!tag.starts_with("</")) {
    open.push_back(name_of(tag));
  } else if (open.empty() || open.back() != name_of(tag)) {
    faults.push_back(tag + " closes " + (open.empty() ? "nothing" : open.back()));
  } else {
    open.pop_back();
  }
}

}  // namespace

std::vector<std::string> markup_faults(std::string_view page) {
  constexpr std::string_view kDoctype = "<!DOCTYPE html>";
  std::vector<std::string> faults;
  std::vector<std::string> open;
  if (page.starts_with(kDoctype)) {
    page.remove_prefix(kDoctype.size());
  }
  check_entities(page, faults);
  for (std::size_t at = page.find('<'); at != std::string_view::npos; at = page.find('<', at + 1)) {
    const std::size_t end = page.find('>', at);
    if (end == std::string_view::npos) {
      faults.emplace_back("a tag without end");
      return faults;
    }
    check_tag(std::string(page.substr(at, end + 1 - at)), open, faults);
  }
  for (const std::string& name : open) {
    faults.push_back("never closed: " + name);
  }
  return faults;
}

}  // namespace sketchloc::testing
