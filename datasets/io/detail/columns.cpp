#include "datasets/io/detail/columns.hpp"

#include <cmath>
#include <string>

#include "motion/number_text.hpp"

namespace sketchloc::detail {
namespace {

constexpr std::string_view kBlanks = " \t";

std::string_view without_leading_blanks(std::string_view text) {
  const std::size_t start = text.find_first_not_of(kBlanks);
  return start == std::string_view::npos ? std::string_view() : text.substr(start);
}

std::string_view trimmed(std::string_view text) {
  text = without_leading_blanks(text);
  const std::size_t last = text.find_last_not_of(kBlanks);
  return text.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

}  // namespace

bool is_within(const std::optional<double>& value, double limit) {
  return value && std::abs(*value) <= limit;  // false for NaN
}

std::string number_within(double limit) {
  std::string text = "a number from ";
  append_number(text, -limit);
  text += " to ";
  append_number(text, limit);
  return text;
}

Columns::Columns(std::string_view line, const Place& place, char separator)
    : rest_(without_leading_blanks(line)),
      place_(&place),
      separator_(separator),
      at_end_(rest_.empty()) {}

Columns Columns::blank_separated(std::string_view line, const Place& place) {
  return {line, place, ' '};
}

Columns Columns::comma_separated(std::string_view line, const Place& place) {
  return {line, place, ','};
}

std::string_view Columns::take() {
  if (separator_ == ' ') {
    const std::size_t end = std::min(rest_.find_first_of(kBlanks), rest_.size());
    const std::string_view column = rest_.substr(0, end);
    rest_ = without_leading_blanks(rest_.substr(end));
    at_end_ = rest_.empty();
    return column;
  }
  const std::size_t comma = rest_.find(separator_);
  const std::string_view column = trimmed(rest_.substr(0, comma));
  at_end_ = comma == std::string_view::npos;
  rest_ = at_end_ ? std::string_view() : rest_.substr(comma + 1);
  return column;
}

std::string_view Columns::text(std::string_view field) {
  if (at_end_) {
    fail_expected(*place_, field, "a value", "the end of the line",
                  "the line is too short: complete it or remove it");
  }
  return take();
}

double Columns::number(std::string_view field, double limit) {
  const std::string_view column = text(field);
  const std::optional<double> value = parse_number<double>(column);
  if (!is_within(value, limit)) {
    fail_expected(*place_, field, number_within(limit), in_quotes(column),
                  "correct the value or remove the line");
  }
  return *value;
}

std::int64_t Columns::integer(std::string_view field, std::int64_t low, std::int64_t high) {
  const std::string_view column = text(field);
  const std::optional<std::int64_t> number = parse_number<std::int64_t>(column);
  if (!number || *number < low || *number > high) {
    fail_expected(*place_, field,
                  "an integer from " + std::to_string(low) + " to " + std::to_string(high),
                  in_quotes(column), "correct the value or remove the line");
  }
  return *number;
}

void Columns::skip(std::size_t count, std::string_view field) {
  for (std::size_t i = 0; i < count; ++i) {
    text(field);
  }
}

void Columns::expect_end() {
  if (!at_end_) {
    fail_expected(*place_, "columns", "the end of the line", in_quotes(rest_),
                  "the line is too long: check the count of its values");
  }
}

}  // namespace sketchloc::detail
