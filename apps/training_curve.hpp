#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace sketchloc {

/// A learning curve as CSV: samples, seconds of learning over all sittings, then what a task
/// measures, one row for each point.
std::string curve_header(std::span<const std::string_view> columns);
std::string curve_row(std::uint64_t samples, double seconds, std::span<const double> columns);

/// The rows of an earlier CSV up to a number of samples, what a checkpoint made then has seen,
/// behind the header. Throws std::runtime_error where a row has no number.
std::string curve_until(std::string_view csv, std::string_view header, std::uint64_t samples);

/// One panel of the picture: a column over the samples, from 0 to the last value of another
/// column, or to 100.
struct CurvePanel {
  const char* title = "";
  const char* column = "";
  const char* top_column = nullptr;  ///< none: 100
  const char* unit = "";
};

/// The curve as a picture: the bytes of an SVG file. Empty for fewer than two points.
std::string curve_svg(std::string_view csv, std::span<const CurvePanel> panels);

/// The seconds in a curve's last row; 0 without one.
double seconds_of_curve(std::string_view csv);

}  // namespace sketchloc
