#include "apps/option_checks.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>

#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

/// "a, b or c".
std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  }
  return text;
}

std::string complaint(const std::string& expected, const std::string& text) {
  return "must be " + expected + ", but it is '" + text + "'";
}

template <typename Number, typename Holds>
OptionCheck number_that(const std::string& expected, Holds holds) {
  const auto check = [expected, holds](const std::string& text) {
    const std::optional<Number> number = parse_number<Number>(text);
    return number && holds(*number) ? std::string() : complaint(expected, text);
  };
  return check;
}

}  // namespace

OptionCheck positive_number() {
  return number_that<double>("a number above 0",
                             [](double n) { return std::isfinite(n) && n > 0.0; });
}

OptionCheck non_negative_number() {
  return number_that<double>("a number, 0 or more",
                             [](double n) { return std::isfinite(n) && n >= 0.0; });
}

OptionCheck whole_number() {
  return number_that<std::uint64_t>("a whole number, 0 or more",
                                    [](std::uint64_t) { return true; });
}

OptionCheck one_of(const std::vector<std::string>& names) {
  const auto check = [names](const std::string& text) {
    const bool known = std::ranges::find(names, text) != names.end();
    return known ? std::string() : complaint(listed(names), text);
  };
  return check;
}

CLI::Option* add_checked_option(CLI::App& command, const std::string& flag, const std::string& help,
                                const OptionCheck& check,
                                const std::function<void(const std::string&)>& set) {
  return command.add_option_function<std::string>(flag, set, help)->check(check)->type_name("NAME");
}

}  // namespace sketchloc
