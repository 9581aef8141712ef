#include "eval/detail/chart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "eval/detail/svg.hpp"
#include "eval/detail/text.hpp"

namespace sketchloc::detail {
namespace {

constexpr double kBox = 1000.0;  ///< the curves' user space is kBox x kBox, stretched by CSS

/// Columns of a curve; what lies in one is drawn as its lowest and highest value.
constexpr int kColumns = 500;

double x_in_box(const Chart& chart, double x) { return kBox * x / chart.x_high; }

/// Height above the axis; a little beyond the box for what the chart cuts off.
double height_in_box(const Chart& chart, double y) {
  const double share = (y - chart.y_low) / (chart.y_high - chart.y_low);
  return kBox * std::clamp(share, -0.1, 1.1);
}

double y_in_box(const Chart& chart, double y) { return kBox - height_in_box(chart, y); }

std::vector<Polyline> split_at_gaps(const Polyline& points) {
  std::vector<Polyline> lines(1);
  for (const Eigen::Vector2d& point : points) {
    if (point.allFinite()) {
      lines.back().push_back(point);
    } else if (!lines.back().empty()) {
      lines.emplace_back();
    }
  }
  return lines;
}

void append_extremes(Polyline& thin, std::span<const Eigen::Vector2d> column) {
  const auto by_y = [](const Eigen::Vector2d& point) { return point.y(); };
  const auto [low, high] = std::ranges::minmax_element(column, {}, by_y);
  thin.push_back(low < high ? *low : *high);
  if (low != high) {
    thin.push_back(low < high ? *high : *low);
  }
}

/// The line with at most two points per column, so that long runs stay small pages.
Polyline thinned(const Polyline& line, double x_high) {
  if (line.size() <= 2 * kColumns) {
    return line;
  }
  const auto column_of = [&](const Eigen::Vector2d& point) {
    return static_cast<int>(kColumns * point.x() / x_high);
  };
  Polyline thin;
  for (std::size_t first = 0; first < line.size();) {
    std::size_t end = first;
    while (end < line.size() && column_of(line[end]) == column_of(line[first])) {
      ++end;
    }
    append_extremes(thin, std::span(line).subspan(first, end - first));
    first = end;
  }
  return thin;
}

std::string curve_data(const Chart& chart, const Curve& curve) {
  std::string data;
  for (const Polyline& line : split_at_gaps(curve.points)) {
    Polyline box;
    for (const Eigen::Vector2d& point : thinned(line, chart.x_high)) {
      box.emplace_back(x_in_box(chart, point.x()), height_in_box(chart, point.y()));
    }
    if (curve.filled && !box.empty()) {
      box.insert(box.begin(), Eigen::Vector2d(box.front().x(), 0.0));
      box.emplace_back(box.back().x(), 0.0);
    }
    const std::vector<Polyline> one = {box};
    data += path_data(one, SketchToSvg{kBox});
  }
  return data;
}

std::string curve_svg(const Chart& chart, const Curve& curve) {
  const std::string data = curve_data(chart, curve);
  if (data.empty()) {
    return {};
  }
  if (curve.filled) {
    return "<path d=\"" + data + "\" fill=\"" + hex(curve.colour) + "\" fill-opacity=\"0.22\"/>";
  }
  return stroke(data, curve.colour, 1.8, curve.dashed ? " stroke-dasharray=\"4 4\"" : "");
}

std::string line_svg(double x1, double y1, double x2, double y2, const std::string& css_class) {
  return "<line class=\"" + css_class + "\" x1=\"" + svg_number(x1) + "\" y1=\"" + svg_number(y1) +
         "\" x2=\"" + svg_number(x2) + "\" y2=\"" + svg_number(y2) + "\"/>";
}

std::string label_html(const std::string& css_class, const std::string& side, double percent_there,
                       const std::string& text) {
  return "<span class=\"" + css_class + "\" style=\"" + side + ":" + fixed(percent_there, 2) +
         "%\">" + escaped(text) + "</span>";
}

int tick_decimals(std::span<const double> ticks) {
  const double step = ticks.size() > 1 ? ticks[1] - ticks[0] : 1.0;
  return std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6);
}

double height_percent(const Chart& chart, double y) {
  return 100.0 * height_in_box(chart, y) / kBox;
}

std::string legend_html(const Chart& chart) {
  std::string html = "<span class=\"legend\">";
  for (const Curve& curve : chart.curves) {
    const std::string look = curve.filled ? "area" : curve.dashed ? "dash" : "line";
    html += "<span><i class=\"" + look + "\" style=\"color:" + hex(curve.colour) + "\"></i>" +
            escaped(curve.name) + "</span>";
  }
  return html + "</span>";
}

std::string shapes_svg(const Chart& chart, std::span<const double> y_ticks) {
  std::string svg =
      "<svg viewBox=\"0 0 1000 1000\" preserveAspectRatio=\"none\" role=\"img\" aria-label=\"" +
      escaped(chart.title + " over " + chart.x_name + ". " + chart.caption) + "\">";
  for (const double y : y_ticks) {
    svg += line_svg(0.0, y_in_box(chart, y), kBox, y_in_box(chart, y), "grid");
  }
  for (const ChartMark& mark : chart.marks) {
    svg += line_svg(x_in_box(chart, mark.x), 0.0, x_in_box(chart, mark.x), kBox, "moment");
  }
  for (const Curve& curve : chart.curves) {
    svg += curve_svg(chart, curve);
  }
  for (const Guide& guide : chart.guides) {
    svg += line_svg(0.0, y_in_box(chart, guide.y), kBox, y_in_box(chart, guide.y), "guide");
  }
  return svg + "</svg>";
}

std::string labels_html(const Chart& chart, std::span<const double> y_ticks) {
  std::string html;
  for (const double y : y_ticks) {
    html +=
        label_html("ytick", "bottom", height_percent(chart, y), fixed(y, tick_decimals(y_ticks)));
  }
  const std::vector<double> x_ticks = round_ticks(0.0, chart.x_high, 5);
  for (const double x : x_ticks) {
    html += label_html("xtick", "left", 100.0 * x / chart.x_high, fixed(x, tick_decimals(x_ticks)));
  }
  for (const Guide& guide : chart.guides) {
    html += label_html("guide", "bottom", height_percent(chart, guide.y), guide.label);
  }
  for (const ChartMark& mark : chart.marks) {
    html += label_html("badge top", "left", 100.0 * mark.x / chart.x_high, mark.letter);
  }
  return html + "<span class=\"xunit\">" + escaped(chart.x_name + ", " + chart.x_unit) + "</span>";
}

}  // namespace

std::vector<double> round_ticks(double low, double high, int count) {
  const double raw = (high - low) / count;
  if (!(raw > 0.0) || !std::isfinite(raw)) {
    return {low};
  }
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double lead = raw / power;
  const double step = power * (lead <= 1.0 ? 1.0 : lead <= 2.0 ? 2.0 : lead <= 5.0 ? 5.0 : 10.0);
  std::vector<double> ticks;
  const double slack = 1e-9 * step;
  for (double index = std::ceil((low - slack) / step); index * step <= high + slack; index += 1.0) {
    ticks.push_back(index * step);
  }
  return ticks;
}

void fit_y_range(Chart& chart) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Curve& curve : chart.curves) {
    for (const Eigen::Vector2d& point : curve.points) {
      if (point.allFinite()) {
        low = std::min(low, point.y());
        high = std::max(high, point.y());
      }
    }
  }
  if (!(low <= high)) {
    low = 0.0;
    high = 1.0;
  }
  const double room = 0.05 * std::max(high - low, 1e-6 * std::max(1.0, std::abs(high)));
  chart.y_low = low >= 0.0 && low < 0.5 * high ? 0.0 : low - room;
  chart.y_high = high + room;
}

std::string chart_html(const Chart& chart) {
  const std::vector<double> y_ticks = round_ticks(chart.y_low, chart.y_high, 5);
  return "<figure class=\"chart\"><figcaption><strong>" + escaped(chart.title) + "</strong>, " +
         escaped(chart.unit) + legend_html(chart) + "</figcaption><div class=\"plot\">" +
         shapes_svg(chart, y_ticks) + labels_html(chart, y_ticks) + "</div>" +
         (chart.caption.empty() ? "" : "<p class=\"note\">" + escaped(chart.caption) + "</p>") +
         "</figure>";
}

}  // namespace sketchloc::detail
