#include "apps/training_curve.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace sketchloc {
namespace {

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

constexpr double kPanelWidth = 420.0;
constexpr double kPanelHeight = 260.0;
constexpr double kMargin = 50.0;

std::string text_svg(double x, double y, const char* anchor, const std::string& text) {
  return "<text x=\"" + tenths(x) + "\" y=\"" + tenths(y) + "\" text-anchor=\"" + anchor + "\">" +
         text + "</text>\n";
}

std::string panel_svg(const CurvePanel& panel, std::string_view csv, double left) {
  const std::vector<double> samples = column_of(csv, "samples");
  const std::vector<double> errors = column_of(csv, panel.column);
  const double high = panel.top_column == nullptr ? 100.0 : column_of(csv, panel.top_column).back();
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
                  std::string(panel.title) + ", " + panel.unit +
                      (panel.top_column == nullptr ? "" : " (top: the priors)") + "; last " +
                      tenths(errors.back()));
}

}  // namespace

std::string curve_svg(std::string_view csv, std::span<const CurvePanel> panels) {
  if (lines_of(csv).size() < 3) {
    return {};
  }
  const auto count = static_cast<double>(panels.size());
  const double width = count * (kPanelWidth + 2.0 * kMargin);
  const double height = kPanelHeight + 2.0 * kMargin;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + tenths(width) +
                    " " + tenths(height) + "\" font-family=\"sans-serif\" font-size=\"13\">\n" +
                    "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  double left = 1.2 * kMargin;
  for (const CurvePanel& panel : panels) {
    svg += panel_svg(panel, csv, left);
    left += kPanelWidth + 1.8 * kMargin;
  }
  return svg + "</svg>\n";
}

std::string curve_header(std::span<const std::string_view> columns) {
  std::string header = "samples,seconds";
  for (const std::string_view column : columns) {
    header.append(",").append(column);
  }
  return header + "\n";
}

std::string curve_row(std::uint64_t samples, double seconds, std::span<const double> columns) {
  std::string row = std::to_string(samples);
  append(row, seconds);
  for (const double column : columns) {
    append(row, column);
  }
  return row + "\n";
}

std::string curve_until(std::string_view csv, std::string_view header, std::uint64_t samples) {
  std::string kept(header);
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
