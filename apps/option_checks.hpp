#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace sketchloc {

// Checks of what people type, with messages for people: CLI11's own state the largest double with
// all its digits, take -1 for 2^64 - 1, and print tables from names to numbers.

/// Says what is wrong with a text; empty: nothing.
using OptionCheck = std::function<std::string(const std::string&)>;

OptionCheck positive_number();      ///< above 0
OptionCheck non_negative_number();  ///< 0 or more
OptionCheck whole_number();         ///< 0 or more, without sign
OptionCheck one_of(const std::vector<std::string>& names);

template <typename T>
OptionCheck one_of(const std::map<std::string, T>& values) {
  std::vector<std::string> names;
  for (const auto& [name, value] : values) {
    names.push_back(name);
  }
  return one_of(names);
}

/// An option that hands its text to `set` once `check` has nothing to say.
CLI::Option* add_checked_option(CLI::App& command, const std::string& flag, const std::string& help,
                                const OptionCheck& check,
                                const std::function<void(const std::string&)>& set);

/// An option whose values have names. `values` must outlive the command.
template <typename T, typename Field>
CLI::Option* add_named_option(CLI::App& command, const std::string& flag, Field& field,
                              const std::map<std::string, T>& values, const std::string& help) {
  const auto set = [&field, &values](const std::string& name) { field = values.at(name); };
  return add_checked_option(command, flag, help, one_of(values), set);
}

/// The name of a value that has one.
template <typename T>
std::string name_of(const std::map<std::string, T>& names, T value) {
  return std::ranges::find(names, value, &std::pair<const std::string, T>::second)->first;
}

}  // namespace sketchloc
