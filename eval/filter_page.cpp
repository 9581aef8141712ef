#include <algorithm>
#include <array>

#include "eval/detail/chart.hpp"
#include "eval/detail/page_table.hpp"
#include "eval/detail/style.hpp"
#include "eval/detail/text.hpp"
#include "eval/filter_summary.hpp"
#include "motion/angles.hpp"

namespace sketchloc {
namespace {

using detail::fixed;
using detail::with_interval;

constexpr double kDegrees = deg_from_rad(1.0);
constexpr std::array<detail::Colour, 9> kColours = {{{110, 110, 118},
                                                     {0, 158, 115},
                                                     {230, 159, 0},
                                                     {213, 68, 0},
                                                     {86, 180, 233},
                                                     {150, 80, 150},
                                                     {120, 94, 20},
                                                     {0, 100, 190},
                                                     {20, 20, 24}}};

std::string main_table(std::span<const FilterRow> rows) {
  std::vector<std::vector<std::string>> lines;
  for (const FilterRow& row : rows) {
    lines.push_back({row.kind, row.method, std::to_string(row.sets), std::to_string(row.trials),
                     with_interval(row.mean_error_m, 100.0, 0),
                     with_interval(row.median_error_m, 100.0, 0),
                     with_interval(row.mean_heading_rad, kDegrees, 1),
                     with_interval(row.share_within_1_m, 100.0, 0),
                     with_interval(row.share_within_2_m, 100.0, 0),
                     with_interval(row.share_ever_lost, 100.0, 0),
                     with_interval(row.share_lost_at_end, 100.0, 0),
                     row.nees_inside_95 ? fixed(100.0 * *row.nees_inside_95, 0) : ""});
  }
  return detail::results_table(
             {"runs", "method", "sets", "n", "mean cm", "median cm", "heading deg", "in 1 m %",
              "in 2 m %", "ever lost %", "lost at end %", "in its 95 %"},
             lines) +
         "<p class=\"note\">Position errors in local metres of the reference, over all scored "
         "steps; "
         "n: runs, sets times seeds. Lost: more than 3 m off for 5 m of way or until the end. In "
         "its "
         "95&#160;%: steps whose true position lies in the stated ellipse (none is stated without "
         "a "
         "filter). In brackets: 95&#160;% intervals, by bootstrap over the sets.</p>";
}

std::string difference_table(std::span<const FilterDifference> differences) {
  std::vector<std::vector<std::string>> lines;
  for (const FilterDifference& difference : differences) {
    lines.push_back({difference.kind, difference.method + " minus " + difference.other,
                     with_interval(difference.mean_error_m, 100.0, 0),
                     with_interval(difference.share_within_2_m, 100.0, 0)});
  }
  return detail::results_table({"runs", "methods", "mean error, cm", "within 2 m, points"}, lines) +
         "<p class=\"note\">On the same runs, over all seeds of each method.</p>";
}

/// One chart for each kind, a curve for each method.
std::string charts(std::span<const FilterRow> rows, const std::string& what, double y_high,
                   const std::string& unit,
                   const std::vector<std::pair<double, double>> FilterRow::*curve) {
  std::vector<std::string> kinds;
  std::vector<std::string> methods;
  for (const FilterRow& row : rows) {
    for (auto& [names, name] : {std::pair(&kinds, &row.kind), std::pair(&methods, &row.method)}) {
      if (std::ranges::find(*names, *name) == names->end()) {
        names->push_back(*name);
      }
    }
  }
  std::string html;
  for (const std::string& kind : kinds) {
    detail::Chart chart{
        .title = kind + ": " + what, .unit = unit, .x_name = "way driven", .x_unit = "m"};
    chart.y_high = y_high;
    for (const FilterRow& row : rows) {
      if (row.kind != kind) {
        continue;
      }
      const auto colour =
          static_cast<std::size_t>(std::ranges::find(methods, row.method) - methods.begin());
      detail::Curve drawn{.name = row.method, .colour = kColours[colour % kColours.size()]};
      for (const auto& [x, y] : row.*curve) {
        drawn.points.emplace_back(x, std::min(y, y_high));
        chart.x_high = std::max(chart.x_high, x);
      }
      chart.curves.push_back(std::move(drawn));
    }
    html += detail::chart_html(chart);
  }
  return html;
}

}  // namespace

std::string filter_page_html(const std::string& title, const std::string& caption,
                             std::span<const FilterRow> rows,
                             std::span<const FilterDifference> differences) {
  constexpr double kMostShown_m = 4.0;
  return detail::open_page(title) + "<header><h1>" + detail::escaped(title) + "</h1><p>" +
         detail::escaped(caption) + "</p></header><main>" +
         detail::section("Errors", main_table(rows)) +
         detail::section("How long until it is lost?",
                         charts(rows, "share not lost yet", 1.0, "0 to 1", &FilterRow::survival)) +
         detail::section("Error along the way",
                         charts(rows, "median error (cut off at 4 m)", kMostShown_m, "m",
                                &FilterRow::error_by_way)) +
         (differences.empty()
              ? std::string()
              : detail::section("Paired differences", difference_table(differences))) +
         "</main>" + detail::close_page();
}

}  // namespace sketchloc
