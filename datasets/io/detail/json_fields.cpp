#include "datasets/io/detail/json_fields.hpp"

#include <algorithm>

#include "datasets/io/detail/columns.hpp"

namespace sketchloc::detail {
namespace {

using Json = nlohmann::json;

constexpr int kDeepest = 8;
constexpr const char* kWhatToDo = "the fields are listed in docs/formats.md";

}  // namespace

Json parse_json(std::string_view text, const Place& place) {
  const auto limit_depth = [&place](int depth, Json::parse_event_t, const Json&) {
    if (depth > kDeepest) {
      fail(place,
           "JSON: expected at most " + std::to_string(kDeepest) + " levels of nesting, found more");
    }
    return true;
  };
  try {
    return Json::parse(text.begin(), text.end(), limit_depth);
  } catch (const Json::parse_error& error) {
    for (const std::string_view word : {"NaN", "nan", "Infinity"}) {
      if (text.find(word) != std::string_view::npos) {
        fail(place, "JSON: " + std::string(word) + " is no JSON; use null for no return");
      }
    }
    fail(place, "JSON: it stops making sense at byte " + std::to_string(error.byte) + " of " +
                    std::to_string(text.size()) + "; write one whole object per line");
  } catch (const Json::exception& error) {
    fail(place, std::string("JSON: ") + error.what());
  }
}

JsonFields::JsonFields(const Json& json, std::string path, const Place& place,
                       std::initializer_list<std::string_view> keys)
    : json_(&json), path_(std::move(path)), place_(&place) {
  if (!json.is_object()) {
    fail_expected(place, path_.empty() ? "line" : path_, "an object", in_words(json), kWhatToDo);
  }
  for (const auto& item : json.items()) {
    if (std::ranges::find(keys, item.key()) == keys.end()) {
      fail(place, "unknown field " + in_quotes(path_of(item.key())) + "; " + kWhatToDo);
    }
  }
}

bool JsonFields::has(std::string_view key) const { return json_->find(key) != json_->end(); }

const Json& JsonFields::value(std::string_view key) const {
  const auto found = json_->find(key);
  if (found == json_->end()) {
    fail(*place_, "no " + in_quotes(path_of(key)) + "; " + kWhatToDo);
  }
  return *found;
}

double JsonFields::number(std::string_view key, double limit) const {
  const Json& found = value(key);
  const std::optional<double> number =
      found.is_number() ? std::optional(found.get<double>()) : std::nullopt;
  if (!is_within(number, limit)) {
    fail_expected(*place_, path_of(key), number_within(limit), in_words(found),
                  "correct the value");
  }
  return *number;
}

const Json& JsonFields::array(std::string_view key) const {
  const Json& found = value(key);
  if (!found.is_array()) {
    fail_expected(*place_, path_of(key), "an array", in_words(found), kWhatToDo);
  }
  return found;
}

JsonFields JsonFields::object(std::string_view key,
                              std::initializer_list<std::string_view> keys) const {
  return {value(key), path_of(key), *place_, keys};
}

std::string JsonFields::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

std::string in_words(const Json& json) {
  if (json.is_string()) {
    return "the string " + in_quotes(json.get_ref<const std::string&>());
  }
  if (json.is_array() || json.is_object()) {
    return std::string("an ") + json.type_name();
  }
  return json.dump();
}

}  // namespace sketchloc::detail
