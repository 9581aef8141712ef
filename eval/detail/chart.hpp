#pragma once

#include <string>
#include <vector>

#include "eval/detail/run_picture.hpp"

namespace sketchloc::detail {

/// One curve; a NaN in y breaks it.
struct Curve {
  std::string name;
  Colour colour;
  Polyline points = {};
  bool filled = false;  ///< area down to the axis instead of a line
  bool dashed = false;
};

/// A horizontal line with a meaning, e.g. 1 m.
struct Guide {
  double y = 0.0;
  std::string label;
};

/// A moment on the axis.
struct ChartMark {
  double x = 0.0;
  std::string letter;
};

/// Curves over time or over another number. Everything beyond y_high is cut off, so the caption
/// should say so.
struct Chart {
  std::string title;
  std::string unit;
  std::string caption = {};
  double x_high = 1.0;
  std::string x_name = "time";
  std::string x_unit;
  double y_low = 0.0;
  double y_high = 1.0;
  std::vector<Curve> curves = {};
  std::vector<Guide> guides = {};
  std::vector<ChartMark> marks = {};
};

/// Round values (1, 2 or 5 times a power of ten apart) from low to high, about `count` of them.
std::vector<double> round_ticks(double low, double high, int count);

/// The smallest range of y that holds all curves, widened to round numbers.
void fit_y_range(Chart& chart);

/// A <figure>: the curves stretch with the page, the text keeps its size.
std::string chart_html(const Chart& chart);

}  // namespace sketchloc::detail
