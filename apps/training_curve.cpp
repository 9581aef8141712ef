#include "apps/training_curve.hpp"

#include <charconv>
#include <cstdio>
#include <sstream>
#include <stdexcept>

#include "motion/angles.hpp"

namespace sketchloc {
namespace {

constexpr double kCmPerM = 100.0;

template <typename T>
T number_of(std::string_view text) {
  T number{};
  if (std::from_chars(text.data(), text.data() + text.size(), number).ec != std::errc{}) {
    throw std::runtime_error("curve.csv: a row begins with \"" + std::string(text) +
                             "\" instead of numbers; give --force to begin anew");
  }
  return number;
}

std::vector<std::string_view> lines_of(std::string_view csv) {
  std::vector<std::string_view> lines;
  while (!csv.empty()) {
    const std::size_t end = std::min(csv.find('\n'), csv.size() - 1);
    lines.push_back(csv.substr(0, end + 1));
    csv.remove_prefix(end + 1);
  }
  return lines;
}

void append(std::string& row, double value) {
  char text[32];
  std::snprintf(text, sizeof text, ",%.5g", value);
  row += text;
}

void append(std::string& row, const ErrorSummary& summary, double per_unit) {
  append(row, per_unit * summary.mean);
  append(row, per_unit * summary.median);
  append(row, per_unit * summary.p90);
}

}  // namespace

std::string curve_header() {
  return "samples,seconds,loss,loss_grid,loss_pose,loss_spread,loss_inlier,"
         "position_mean_cm,position_median_cm,position_p90_cm,"
         "heading_mean_deg,heading_median_deg,heading_p90_deg,failures,"
         "prior_position_median_cm,prior_heading_median_deg\n";
}

std::string curve_row(const CurvePoint& point) {
  std::string row = std::to_string(point.samples);
  append(row, point.seconds);
  for (const double loss :
       {point.loss.total, point.loss.grid, point.loss.pose, point.loss.spread, point.loss.inlier}) {
    append(row, loss);
  }
  const ValidationReport& validation = point.validation;
  append(row, validation.position_m, kCmPerM);
  append(row, validation.heading_rad, deg_from_rad(1.0));
  row += "," + std::to_string(validation.failures);
  append(row, kCmPerM * validation.prior_position_m.median);
  append(row, deg_from_rad(validation.prior_heading_rad.median));
  return row + "\n";
}

std::string curve_until(std::string_view csv, std::uint64_t samples) {
  std::string kept = curve_header();
  const std::vector<std::string_view> lines = lines_of(csv);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (number_of<std::uint64_t>(lines[i]) <= samples) {
      kept += lines[i];
    }
  }
  return kept;
}

double seconds_of_curve(std::string_view csv) {
  const std::vector<std::string_view> lines = lines_of(csv);
  if (lines.size() < 2) {
    return 0.0;
  }
  const std::string_view last = lines.back();
  const std::size_t comma = last.find(',');
  return comma == last.npos ? 0.0 : number_of<double>(last.substr(comma + 1));
}

}  // namespace sketchloc
