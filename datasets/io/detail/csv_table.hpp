#pragma once

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/io/detail/columns.hpp"

namespace sketchloc::detail {

/// One row of a CSV with a header line; columns go by name.
class CsvRow {
 public:
  CsvRow(std::span<const std::string> header, std::span<const std::string_view> values,
         const Place& place)
      : header_(header), values_(values), place_(&place) {}

  double number(std::string_view column, double limit) const;             ///< in [-limit, limit]
  double above_zero(std::string_view column, double limit) const;         ///< in (0, limit]
  double at_least_zero(std::string_view column, double limit) const;      ///< in [0, limit]
  std::size_t index(std::string_view column) const;                       ///< an integer from 0 on
  double within(std::string_view column, double low, double high) const;  ///< in [low, high]
  bool flag(std::string_view column) const;                               ///< 0 or 1
  /// Which of the given words the column holds, by index.
  std::size_t choice(std::string_view column, std::initializer_list<std::string_view> words) const;
  const Place& place() const { return *place_; }

 private:
  std::string_view text(std::string_view column) const;

  std::span<const std::string> header_;
  std::span<const std::string_view> values_;
  const Place* place_;
};

/// Gives every row to `take`. An error names file, line and column: a column that is missing from
/// the header, a row with another number of values, no row at all.
void for_each_csv_row(const std::filesystem::path& csv,
                      std::initializer_list<std::string_view> columns,
                      const std::function<void(const CsvRow&)>& take);

}  // namespace sketchloc::detail
