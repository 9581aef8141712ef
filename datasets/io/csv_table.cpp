#include "datasets/io/csv_table.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "datasets/io/detail/columns.hpp"
#include "datasets/io/detail/line_reader.hpp"
#include "motion/check.hpp"
#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

using namespace detail;

constexpr const char* kWhatToDo = "correct the value";

std::vector<std::string_view> split(std::string_view line, const Place& place) {
  Columns columns = Columns::comma_separated(line, place);
  std::vector<std::string_view> values;
  while (!columns.at_end()) {
    values.push_back(columns.text("value"));
  }
  return values;
}

std::vector<std::string> read_header(LineReader& lines, std::span<const std::string_view> columns) {
  const std::optional<std::string_view> line = lines.next();
  if (!line || line->empty()) {
    detail::fail(
        {.file = lines.place().file, .line = 1},
        "header: expected a line with the names of the columns, found nothing; is the file empty?");
  }
  const std::vector<std::string_view> names = split(*line, lines.place());
  for (const std::string_view column : columns) {
    if (std::ranges::count(names, column) != 1) {
      fail_expected(lines.place(), "header", "one column " + in_quotes(column), in_quotes(*line),
                    "the columns are listed in docs/formats.md");
    }
  }
  return {names.begin(), names.end()};
}

}  // namespace

std::string_view CsvRow::text(std::string_view column) const {
  const auto found = std::ranges::find(header_, column);
  check(found != header_.end(), "a column that was not asked for");
  return values_[static_cast<std::size_t>(found - header_.begin())];
}

double CsvRow::number(std::string_view column, double limit) const {
  const std::optional<double> value = parse_number<double>(text(column));
  if (!is_within(value, limit)) {
    fail_expected(*place_, column, number_within(limit), in_quotes(text(column)), kWhatToDo);
  }
  return *value;
}

double CsvRow::above_zero(std::string_view column, double limit) const {
  const double value = number(column, limit);
  if (!(value > 0.0)) {
    fail_expected(*place_, column, "a number above 0", in_quotes(text(column)), kWhatToDo);
  }
  return value;
}

double CsvRow::at_least_zero(std::string_view column, double limit) const {
  const double value = number(column, limit);
  if (!(value >= 0.0)) {
    fail_expected(*place_, column, "a number of at least 0", in_quotes(text(column)), kWhatToDo);
  }
  return value;
}

std::size_t CsvRow::index(std::string_view column) const {
  const std::optional<std::int64_t> number = parse_number<std::int64_t>(text(column));
  if (!number || *number < 0) {
    fail_expected(*place_, column, "an integer from 0 on", in_quotes(text(column)), kWhatToDo);
  }
  return static_cast<std::size_t>(*number);
}

std::size_t CsvRow::count(std::string_view column) const {
  constexpr double kMost = 9007199254740992.0;  // up to here a double counts
  const std::optional<double> number = parse_number<double>(text(column));
  if (!number || !(*number >= 0.0 && *number <= kMost) || *number != std::floor(*number)) {
    fail_expected(*place_, column, "a whole number from 0 to " + number_text(std::int64_t{1} << 53),
                  in_quotes(text(column)), kWhatToDo);
  }
  return static_cast<std::size_t>(*number);
}

double CsvRow::within(std::string_view column, double low, double high) const {
  const std::optional<double> value = parse_number<double>(text(column));
  if (!value || !(*value >= low && *value <= high)) {
    const std::string range = "a number in [" + number_text(low) + ", " + number_text(high) + "]";
    fail_expected(*place_, column, range, in_quotes(text(column)), kWhatToDo);
  }
  return *value;
}

void CsvRow::fail(std::string_view column, std::string_view expected,
                  std::string_view what_to_do) const {
  fail_expected(*place_, column, expected, in_quotes(text(column)), what_to_do);
}

bool CsvRow::flag(std::string_view column) const { return choice(column, {"0", "1"}) == 1; }

std::size_t CsvRow::choice(std::string_view column,
                           std::initializer_list<std::string_view> words) const {
  const std::string_view word = text(column);
  const auto* const found = std::ranges::find(words, word);
  if (found == words.end()) {
    std::string expected;
    for (const std::string_view& candidate : words) {
      expected += (expected.empty() ? "" : " or ") + std::string(candidate);
    }
    fail_expected(*place_, column, expected, in_quotes(word), kWhatToDo);
  }
  return static_cast<std::size_t>(found - words.begin());
}

void for_each_csv_row(const std::filesystem::path& csv, std::span<const std::string_view> columns,
                      const std::function<void(const CsvRow&)>& take) {
  LineReader lines(csv);
  const std::vector<std::string> header = read_header(lines, columns);
  std::size_t rows = 0;
  while (const std::optional<std::string_view> line = lines.next()) {
    if (line->empty()) {
      continue;
    }
    const std::vector<std::string_view> values = split(*line, lines.place());
    if (values.size() != header.size()) {
      fail_expected(lines.place(), "columns", std::to_string(header.size()) + " as in the header",
                    std::to_string(values.size()), "complete the line or remove it");
    }
    take(CsvRow(header, values, lines.place()));
    ++rows;
  }
  lines.expect_whole();
  if (rows == 0) {
    detail::fail(lines.place(), "rows: expected at least one after the header, found none");
  }
}

}  // namespace sketchloc
