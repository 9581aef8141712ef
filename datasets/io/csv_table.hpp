#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace sketchloc {

namespace detail {
struct Place;
}

/// One row of a CSV with a header line; columns go by name. A value that is not as asked for is an
/// error with file, line and column.
class CsvRow {
 public:
  CsvRow(std::span<const std::string> header, std::span<const std::string_view> values,
         const detail::Place& place)
      : header_(header), values_(values), place_(&place) {}

  double number(std::string_view column, double limit) const;         ///< in [-limit, limit]
  double above_zero(std::string_view column, double limit) const;     ///< in (0, limit]
  double at_least_zero(std::string_view column, double limit) const;  ///< in [0, limit]
  std::size_t index(std::string_view column) const;                   ///< an integer from 0 on
  /// A whole number from 0 to 2^53, also where it is written like 1e+05.
  std::size_t count(std::string_view column) const;
  double within(std::string_view column, double low, double high) const;  ///< in [low, high]
  bool flag(std::string_view column) const;                               ///< 0 or 1
  /// Which of the given words the column holds, by index.
  std::size_t choice(std::string_view column, std::initializer_list<std::string_view> words) const;

  /// The error for a value that does not fit the rows before.
  [[noreturn]] void fail(std::string_view column, std::string_view expected,
                         std::string_view what_to_do) const;

 private:
  std::string_view text(std::string_view column) const;

  std::span<const std::string> header_;
  std::span<const std::string_view> values_;
  const detail::Place* place_;
};

/// Gives every row to `take`. The text may be gzip. An error names file, line and column: a column
/// that is missing from the header, a row with another number of values, no row at all.
void for_each_csv_row(const std::filesystem::path& csv, std::span<const std::string_view> columns,
                      const std::function<void(const CsvRow&)>& take);

inline void for_each_csv_row(const std::filesystem::path& csv,
                             std::initializer_list<std::string_view> columns,
                             const std::function<void(const CsvRow&)>& take) {
  for_each_csv_row(csv, std::span<const std::string_view>(columns.begin(), columns.size()), take);
}

}  // namespace sketchloc
