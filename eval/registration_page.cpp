#include "eval/registration_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>

#include "eval/detail/chart.hpp"
#include "eval/detail/page_table.hpp"
#include "eval/detail/style.hpp"
#include "eval/detail/text.hpp"
#include "eval/registration_suite.hpp"
#include "motion/angles.hpp"

namespace sketchloc {
namespace {

using detail::escaped;
using detail::fixed;
using detail::with_interval;

constexpr double kDegrees = deg_from_rad(1.0);
constexpr std::array<detail::Colour, 6> kColours = {
    {{0, 100, 190}, {213, 68, 0}, {230, 159, 0}, {0, 158, 115}, {150, 80, 150}, {110, 110, 118}}};

std::string main_table(const RegistrationPage& page) {
  std::vector<std::vector<std::string>> lines;
  for (const RegistrationRow& row : page.rows) {
    if (!is_swept(row.kind, row.protocol)) {
      lines.push_back(
          {row.kind, row.method, row.protocol, std::to_string(row.trials),
           fixed(100.0 * row.prior_m.median, 0), with_interval(row.mean_position_m, 100.0, 1),
           fixed(100.0 * row.position_m.median, 1), fixed(100.0 * row.position_m.p90, 0),
           with_interval(row.mean_heading_rad, kDegrees, 1),
           fixed(kDegrees * row.heading_rad.median, 1), with_interval(row.share_nearer, 100.0, 0),
           with_interval(row.share_aligned, 100.0, 0), with_interval(row.share_right, 100.0, 0),
           fixed(row.median_ms, 1)});
    }
  }
  return detail::results_table(
             {"drawings", "method", "priors", "n", "prior cm", "mean cm", "median cm", "p90 cm",
              "mean deg", "median deg", "nearer %", "aligned %", "right %", "ms"},
             lines) +
         "<p class=\"note\">Errors of position and heading; prior: its median error; nearer: than "
         "the prior; aligned: the scan lies on strokes better than at the prior; right: within 0.5 "
         "m and 15 deg. In brackets: 95&#160;% intervals, by "
         "bootstrap over the drives. "
         "Chained: each prior is the last result moved by the odometry, from a true start. A "
         "method "
         "that gives no answer keeps its prior. Published for the chained protocol, other "
         "buildings "
         "[Chen20]: icp 235.95 cm, 95.09 deg; affine 168.39 cm, 57.11 deg; splines 46.25 cm, "
         "18.16 deg.</p>";
}

std::string difference_table(const RegistrationPage& page) {
  std::vector<std::vector<std::string>> lines;
  for (const RegistrationDifference& difference : page.differences) {
    if (is_swept(difference.kind, difference.protocol)) {
      continue;
    }
    lines.push_back({difference.kind, difference.method + " minus " + difference.other,
                     difference.protocol, with_interval(difference.position_m, 100.0, 1),
                     with_interval(difference.heading_rad, kDegrees, 1)});
  }
  return detail::results_table({"drawings", "methods", "priors", "error, cm", "heading, deg"},
                               lines) +
         "<p class=\"note\">Mean differences on the same questions: below zero, the first is "
         "better.</p>";
}

std::vector<std::string> names_in(const RegistrationPage& page,
                                  const std::string RegistrationRow::*name) {
  std::vector<std::string> names;
  for (const RegistrationRow& row : page.rows) {
    if (std::ranges::find(names, row.*name) == names.end()) {
      names.push_back(row.*name);
    }
  }
  return names;
}

/// x of a row on the axis of a sweep; not finite where it is not of the sweep.
using SweepAxis = std::function<double(const RegistrationRow&)>;

struct SweepScale {
  std::string name;
  std::string unit;
  double high;
};

std::string sweep_chart(const RegistrationPage& page, const std::string& title,
                        const SweepScale& scale, const SweepAxis& axis) {
  detail::Chart chart{.title = title,
                      .unit = "cm",
                      .x_high = scale.high,
                      .x_name = scale.name,
                      .x_unit = scale.unit};
  std::size_t colour = 0;
  for (const std::string& method : names_in(page, &RegistrationRow::method)) {
    detail::Curve curve{.name = method, .colour = kColours[colour++ % kColours.size()]};
    for (const RegistrationRow& row : page.rows) {
      const double x = row.method == method ? axis(row) : std::nan("");
      if (std::isfinite(x)) {
        curve.points.emplace_back(x, std::min(100.0 * row.position_m.median, 400.0));
      }
    }
    if (curve.points.size() > 1) {
      chart.curves.push_back(std::move(curve));
    }
  }
  if (chart.curves.empty()) {
    return {};
  }
  chart.caption = "Median position error; beyond 400 cm cut off.";
  detail::fit_y_range(chart);
  return detail::chart_html(chart);
}

/// The number in `text` behind `before`; not finite where it does not begin so.
double number_behind(const std::string& text, const std::string& before) {
  return text.starts_with(before) ? std::strtod(text.c_str() + before.size(), nullptr)
                                  : std::nan("");
}

std::string sweep_charts(const RegistrationPage& page) {
  std::string html;
  for (const std::string& kind : names_in(page, &RegistrationRow::kind)) {
    const auto along = [&](const std::string& before) -> SweepAxis {
      return [kind, before](const RegistrationRow& row) {
        return row.kind == kind ? number_behind(row.protocol, before) : std::nan("");
      };
    };
    html += sweep_chart(page, kind + ": by the prior's shift (turn 10 deg)", {"shift", "m", 3.0},
                        along("shift "));
    html += sweep_chart(page, kind + ": by the prior's turn (shift 0.5 m)", {"turn", "deg", 45.0},
                        along("turn "));
  }
  html += sweep_chart(
      page, "Chained, by the strength of the deformation",
      {"bending", "times that of the training", 2.0}, [](const RegistrationRow& row) {
        return row.protocol == "chained" ? number_behind(row.kind, "tps x ") : std::nan("");
      });
  return html;
}

std::string reliability_chart(const RegistrationRow& row) {
  detail::Chart chart{.title = row.kind + ", " + row.method + ", " + row.protocol,
                      .unit = "share right",
                      .x_high = 1.0,
                      .x_name = "stated probability",
                      .x_unit = "0 to 1",
                      .y_low = 0.0,
                      .y_high = 1.0};
  detail::Curve ideal{.name = "ideal", .colour = kColours[5], .dashed = true};
  ideal.points = {{0.0, 0.0}, {1.0, 1.0}};
  detail::Curve measured{.name = "measured", .colour = kColours[0]};
  detail::Curve low{.name = "95 % interval", .colour = kColours[2]};
  detail::Curve high{.name = "", .colour = kColours[2]};
  for (const ReliabilityBin& bin : row.reliability) {
    measured.points.emplace_back(bin.mean_stated, bin.share_right);
    low.points.emplace_back(bin.mean_stated, bin.interval.low);
    high.points.emplace_back(bin.mean_stated, bin.interval.high);
  }
  chart.curves = {ideal, measured, low, high};
  return detail::chart_html(chart);
}

std::string calibration(const RegistrationPage& page) {
  std::vector<std::vector<std::string>> lines;
  std::string charts;
  for (const RegistrationRow& row : page.rows) {
    if (!row.coverage || is_swept(row.kind, row.protocol)) {
      continue;
    }
    const auto share = [](double value) { return fixed(100.0 * value, 0); };
    lines.push_back({row.kind, row.method, row.protocol, share(row.coverage->pose_68),
                     share(row.coverage->pose_95), share(row.coverage->position_68),
                     share(row.coverage->position_95), fixed(row.inlier_brier, 3)});
    charts += reliability_chart(row);
  }
  if (lines.empty()) {
    return {};
  }
  return detail::section(
      "Does it know how wrong it is?",
      detail::results_table({"drawings", "method", "priors", "pose in 68 %", "in 95 %",
                             "position in 68 %", "in 95 %", "Brier score"},
                            lines) +
          "<p class=\"note\">How many of the true poses (position and heading) lie in "
          "the stated ellipsoids, and below how often a pose is within 0.5 m and 15 deg "
          "by how probable that was said to be.</p>" +
          charts);
}

std::string gallery(const std::string& title, const std::vector<RegistrationExample>& examples) {
  if (examples.empty()) {
    return {};
  }
  std::string html = "<div class=\"gallery\">";
  for (const RegistrationExample& example : examples) {
    html += "<figure>" + example.svg + "<figcaption>" + escaped(example.caption) +
            "</figcaption></figure>";
  }
  return detail::section(title, html + "</div>");
}

}  // namespace

std::string registration_page_html(const RegistrationPage& page) {
  return detail::open_page(page.title) +
         "<style>.gallery{display:grid;grid-template-columns:repeat(auto-fill,minmax(18rem,1fr));"
         "gap:.8rem}.gallery figure{margin:0}.gallery svg{background:#fff}"
         "figcaption{font-size:.85rem;color:var(--soft)}</style><header><h1>" +
         escaped(page.title) + "</h1><p>" + escaped(page.caption) + "</p></header><main>" +
         detail::section("Errors", main_table(page)) + gallery("Typical", page.typical) +
         gallery("The worst", page.worst) +
         detail::section("Error by prior and by deformation", sweep_charts(page)) +
         calibration(page) + detail::section("Paired differences", difference_table(page)) +
         "</main>" + detail::close_page();
}

}  // namespace sketchloc
