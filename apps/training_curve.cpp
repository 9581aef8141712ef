#include "apps/training_curve.hpp"

#include <algorithm>
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

std::string tenths(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

void append(std::string& row, double value) {
  char text[32];
  std::snprintf(text, sizeof text, ",%.5g", value);
  row += text;
}

void append(std::string& row, const ValidationSummary& summary, double per_unit) {
  append(row, per_unit * summary.mean);
  append(row, per_unit * summary.median);
  append(row, per_unit * summary.p90);
}

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = line.find(',');
    fields.push_back(line.substr(0, comma));
    if (comma == line.npos) {
      return fields;
    }
    line.remove_prefix(comma + 1);
  }
}

/// A column of the curve.
std::vector<double> column_of(std::string_view csv, std::string_view name) {
  const std::vector<std::string_view> lines = lines_of(csv);
  std::vector<double> values;
  if (lines.empty()) {
    return values;
  }
  const std::vector<std::string_view> header =
      fields_of(lines.front().substr(0, lines.front().find('\n')));
  const auto column = static_cast<std::size_t>(std::ranges::find(header, name) - header.begin());
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string_view> fields = fields_of(lines[i]);
    values.push_back(column < fields.size() ? number_of<double>(fields[column]) : 0.0);
  }
  return values;
}

/// One panel of the picture: an error over the samples, from 0 to that of the priors.
struct Panel {
  const char* title;
  const char* value;
  const char* prior;
  const char* unit;
};

constexpr double kPanelWidth = 420.0;
constexpr double kPanelHeight = 260.0;
constexpr double kMargin = 50.0;

std::string text_svg(double x, double y, const char* anchor, const std::string& text) {
  return "<text x=\"" + tenths(x) + "\" y=\"" + tenths(y) + "\" text-anchor=\"" + anchor + "\">" +
         text + "</text>\n";
}

std::string panel_svg(const Panel& panel, std::string_view csv, double left) {
  const std::vector<double> samples = column_of(csv, "samples");
  const std::vector<double> errors = column_of(csv, panel.value);
  const double high = column_of(csv, panel.prior).back();
  const auto x = [&](double count) { return left + kPanelWidth * count / samples.back(); };
  const auto y = [&](double error) {
    return kMargin + kPanelHeight * (1.0 - std::clamp(error / high, 0.0, 1.0));
  };
  std::string svg;
  for (int tick = 0; tick <= 4; ++tick) {
    const double share = 0.25 * tick;
    svg += "<path d=\"M" + tenths(left) + " " + tenths(y(share * high)) + "h" +
           tenths(kPanelWidth) + "\" stroke=\"#ddd\"/>\n" +
           text_svg(left - 6.0, y(share * high) + 4.0, "end", tenths(share * high)) +
           text_svg(x(share * samples.back()), kMargin + kPanelHeight + 18.0, "middle",
                    tenths(share * samples.back() / 1e6) + "M");
  }
  std::string line;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    line += (i == 0 ? "M" : "L") + tenths(x(samples[i])) + " " + tenths(y(errors[i]));
  }
  return svg + "<path d=\"" + line + "\" fill=\"none\" stroke=\"#0064be\" stroke-width=\"2\"/>\n" +
         text_svg(left, kMargin - 14.0, "start",
                  std::string(panel.title) + ", " + panel.unit + " (top: the priors); last " +
                      tenths(errors.back()));
}

}  // namespace

std::string curve_svg(std::string_view csv) {
  if (lines_of(csv).size() < 3) {
    return {};
  }
  constexpr Panel kPosition{"Median position error", "position_median_cm",
                            "prior_position_median_cm", "cm"};
  constexpr Panel kHeading{"Median heading error", "heading_median_deg", "prior_heading_median_deg",
                           "deg"};
  const double width = 2.0 * kPanelWidth + 4.0 * kMargin;
  const double height = kPanelHeight + 2.0 * kMargin;
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + tenths(width) + " " +
         tenths(height) + "\" font-family=\"sans-serif\" font-size=\"13\">\n" +
         "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" +
         panel_svg(kPosition, csv, 1.2 * kMargin) +
         panel_svg(kHeading, csv, kPanelWidth + 3.0 * kMargin) + "</svg>\n";
}

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
