#include "eval/table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "eval/detail/style.hpp"
#include "eval/detail/svg.hpp"
#include "eval/detail/text.hpp"
#include "eval/summary.hpp"
#include "motion/angles.hpp"

namespace sketchloc {
namespace {

using detail::escaped;
using detail::fixed;

TableCell mean_cell(const RunSet& set, const std::function<double(const SketchErrors&)>& figure,
                    Rng& rng) {
  std::vector<double> values;
  std::ranges::transform(set.runs, std::back_inserter(values), figure);
  TableCell cell{.value = summarize(values)->mean, .interval = {}};
  if (values.size() > 1) {
    cell.interval = bootstrap_interval(values, {}, rng);
  }
  return cell;
}

/// A run that is never lost counts as lost after all others.
TableCell first_loss_cell(const RunSet& set) {
  std::vector<double> losses_s;
  for (const SketchErrors& run : set.runs) {
    losses_s.push_back(run.first_loss_s.value_or(std::numeric_limits<double>::infinity()));
  }
  const auto middle = losses_s.begin() + static_cast<std::ptrdiff_t>(losses_s.size() / 2);
  std::ranges::nth_element(losses_s, middle);
  return {.value = std::isfinite(*middle) ? std::optional(*middle) : std::nullopt, .interval = {}};
}

TableCell worst_cell(const RunSet& set) {
  return {.value = std::ranges::min(set.runs, {}, &SketchErrors::share_within_2_m).share_within_2_m,
          .interval = {}};
}

TableCell lost_cell(const RunSet& set) {
  const auto lost =
      static_cast<std::size_t>(std::ranges::count(set.runs, true, &SketchErrors::lost_at_end));
  return {.value = static_cast<double>(lost) / static_cast<double>(set.runs.size()),
          .interval = wilson_interval(lost, set.runs.size())};
}

TableRow summarize_set(const RunSet& set, Rng& rng) {
  return {.data_set = set.data_set,
          .method = set.method,
          .runs = set.runs.size(),
          .share_within_1_m = mean_cell(
              set, [](const SketchErrors& run) { return run.share_within_1_m; }, rng),
          .share_within_2_m = mean_cell(
              set, [](const SketchErrors& run) { return run.share_within_2_m; }, rng),
          .worst_within_2_m = worst_cell(set),
          .median_error_m = mean_cell(
              set, [](const SketchErrors& run) { return run.translation_m->median; }, rng),
          .median_heading_rad = mean_cell(
              set, [](const SketchErrors& run) { return run.heading_rad->median; }, rng),
          .first_loss_s = first_loss_cell(set),
          .share_lost_at_end = lost_cell(set)};
}

/// How a figure is printed: multiplied, with so many decimals.
struct Form {
  double factor = 1.0;
  int decimals = 0;
};

constexpr Form kPercent{.factor = 100.0, .decimals = 0};
constexpr Form kMetres{.factor = 1.0, .decimals = 2};
constexpr Form kDegrees{.factor = deg_from_rad(1.0), .decimals = 1};
constexpr Form kSeconds{.factor = 1.0, .decimals = 0};

std::string cell_text(const TableCell& cell, const Form& form) {
  if (!cell.value) {
    return "never";
  }
  const auto number = [&](double value) { return fixed(form.factor * value, form.decimals); };
  std::string text = number(*cell.value);
  if (cell.interval) {
    text += " [" + number(cell.interval->low) + ", " + number(cell.interval->high) + "]";
  }
  return text;
}

struct Column {
  const char* name;
  TableCell TableRow::*cell;
  Form form;
  bool drawn = false;  ///< as a picture from 0 to 1 too
};

const std::vector<Column>& columns() {
  static const std::vector<Column> kColumns = {
      {"within 1 m, %", &TableRow::share_within_1_m, kPercent, true},
      {"within 2 m, %", &TableRow::share_within_2_m, kPercent, true},
      {"worst run within 2 m, %", &TableRow::worst_within_2_m, kPercent},
      {"median error, m", &TableRow::median_error_m, kMetres},
      {"median heading error, deg", &TableRow::median_heading_rad, kDegrees},
      {"first lost, s", &TableRow::first_loss_s, kSeconds},
      {"lost at the end, %", &TableRow::share_lost_at_end, kPercent, true}};
  return kColumns;
}

/// Text of a markdown cell: a bar would end it.
std::string markdown_text(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    safe += c == '|' ? std::string("\\|") : std::string(1, c == '\n' ? ' ' : c);
  }
  return safe;
}

/// The interval as a line, the value as a dot, over 0..1.
std::string interval_svg(const TableCell& cell) {
  const Interval interval = cell.interval.value_or(Interval{*cell.value, *cell.value});
  const auto x = [](double share) { return detail::svg_number(4.0 + 92.0 * share); };
  return "<svg class=\"interval\" viewBox=\"0 0 100 10\" aria-hidden=\"true\">"
         "<path d=\"M4 5H96\" stroke=\"var(--line)\"/><path d=\"M" +
         x(interval.low) + " 5H" + x(interval.high) +
         "\" stroke=\"#0064be\" stroke-width=\"2.5\"/><circle cx=\"" + x(*cell.value) +
         "\" cy=\"5\" r=\"3.2\" fill=\"#0064be\"/></svg>";
}

std::string row_html(const TableRow& row) {
  std::string html = "<tr><td>" + escaped(row.data_set) + "</td><td>" + escaped(row.method) +
                     "</td><td>" + std::to_string(row.runs) + "</td>";
  for (const Column& column : columns()) {
    const TableCell& cell = row.*column.cell;
    html += "<td>" + cell_text(cell, column.form) +
            (column.drawn && cell.value ? interval_svg(cell) : std::string()) + "</td>";
  }
  return html + "</tr>";
}

}  // namespace

std::vector<TableRow> summarize_runs(std::span<const RunSet> sets, std::uint64_t seed) {
  std::vector<TableRow> rows;
  for (const RunSet& set : sets) {
    if (!set.runs.empty()) {
      Rng rng = make_rng(seed, rows.size());
      rows.push_back(summarize_set(set, rng));
    }
  }
  return rows;
}

std::string table_markdown(std::span<const TableRow> rows) {
  std::string head = "| data | method | runs |";
  std::string rule = "|---|---|---|";
  for (const Column& column : columns()) {
    head += std::string(" ") + column.name + " |";
    rule += "---|";
  }
  std::string text = head + "\n" + rule + "\n";
  for (const TableRow& row : rows) {
    text += "| " + markdown_text(row.data_set) + " | " + markdown_text(row.method) + " | " +
            std::to_string(row.runs) + " |";
    for (const Column& column : columns()) {
      text += " " + cell_text(row.*column.cell, column.form) + " |";
    }
    text += "\n";
  }
  return text;
}

std::string table_html(const std::string& title, const std::string& caption,
                       std::span<const TableRow> rows) {
  std::string html = detail::open_page(title) + "<header><h1>" + escaped(title) +
                     "</h1></header><main><section><p>" + escaped(caption) +
                     "</p><div class=\"scroll\"><table class=\"results\"><thead><tr>"
                     "<th>data</th><th>method</th><th>runs</th>";
  for (const Column& column : columns()) {
    html += std::string("<th>") + column.name + "</th>";
  }
  html += "</tr></thead><tbody>";
  for (const TableRow& row : rows) {
    html += row_html(row);
  }
  return html +
         "</tbody></table></div><p class=\"note\">In brackets: 95&#160;% intervals, by "
         "bootstrap over the runs, of rates by Wilson.</p></section></main>" +
         detail::close_page();
}

}  // namespace sketchloc
