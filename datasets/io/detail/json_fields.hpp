#pragma once

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "datasets/io/detail/place.hpp"

namespace sketchloc::detail {

/// Parses one JSON value; errors name file and line. Nesting is limited.
nlohmann::json parse_json(std::string_view text, const Place& place);

/// An object in a line of JSON; every miss is an error with file, line and the path of the field.
class JsonFields {
 public:
  /// `json` must be an object with no other keys than these.
  JsonFields(const nlohmann::json& json, std::string path, const Place& place,
             std::initializer_list<std::string_view> keys);

  bool has(std::string_view key) const;
  double number(std::string_view key, double limit) const;  ///< in [-limit, limit]
  const nlohmann::json& array(std::string_view key) const;
  JsonFields object(std::string_view key, std::initializer_list<std::string_view> keys) const;

  std::string path_of(std::string_view key) const;
  const Place& place() const { return *place_; }

 private:
  const nlohmann::json& value(std::string_view key) const;

  const nlohmann::json* json_;
  std::string path_;
  const Place* place_;
};

/// A JSON value in words fit for a message: `the string "abc"`, `an array`.
std::string in_words(const nlohmann::json& json);

}  // namespace sketchloc::detail
