#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "datasets/io/detail/place.hpp"

namespace sketchloc::detail {

/// Is it a number, and in [-limit, limit]? And the words for that.
bool is_within(const std::optional<double>& value, double limit);
std::string number_within(double limit);

/// The columns of one line, taken from left to right; every miss is an error with file, line and
/// the name of the column.
class Columns {
 public:
  /// Columns parted by blanks (runs of spaces and tabs).
  static Columns blank_separated(std::string_view line, const Place& place);
  /// Columns parted by single commas; blanks around a value do not count.
  static Columns comma_separated(std::string_view line, const Place& place);

  bool at_end() const { return at_end_; }
  /// The next column as it stands.
  std::string_view text(std::string_view field);
  /// The next column as a number in [-limit, limit].
  double number(std::string_view field, double limit);
  /// The next column as an integer in [low, high].
  std::int64_t integer(std::string_view field, std::int64_t low, std::int64_t high);
  /// Takes `count` columns of no interest.
  void skip(std::size_t count, std::string_view field);
  /// An error unless all columns are taken.
  void expect_end();

  const Place& place() const { return *place_; }

 private:
  Columns(std::string_view line, const Place& place, char separator);
  std::string_view take();

  std::string_view rest_;
  const Place* place_;
  char separator_;
  bool at_end_;
};

}  // namespace sketchloc::detail
