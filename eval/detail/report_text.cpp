#include <algorithm>
#include <vector>

#include "eval/detail/report_model.hpp"
#include "eval/detail/text.hpp"
#include "eval/detail/verdict.hpp"
#include "motion/angles.hpp"

namespace sketchloc::detail {
namespace {

constexpr const char* kDegree = "\xC2\xB0";

std::string tile(const std::string& value, const std::string& label) {
  return "<div class=\"tile\"><b>" + value + "</b><span>" + label + "</span></div>";
}

std::string in_degrees(double angle_rad) { return fixed(deg_from_rad(angle_rad), 1) + kDegree; }

double median_stated_sigma_m(const RunRecord& record) {
  std::vector<double> sigma_m;
  for (const StepReport& report : record.steps) {
    sigma_m.push_back(stated_position_sigma_m(report.estimate));
  }
  return sigma_m.empty() ? 0.0 : quantile(sigma_m, 0.5);
}

std::string error_tiles(const SketchErrors& errors) {
  return tile(percent(errors.share_within_1_m), "of the steps within 1&#160;m") +
         tile(percent(errors.share_within_2_m), "of the steps within 2&#160;m") +
         tile(with_unit(errors.translation_m->median, "m"), "median position error") +
         tile(in_degrees(errors.heading_rad->median), "median heading error");
}

std::string stated_tiles(const RunRecord& record) {
  return tile(fixed(static_cast<double>(record.steps.size()), 0), "poses") +
         tile(with_unit(2.0 * median_stated_sigma_m(record), "m"),
              "stated uncertainty (2&#963;, median)");
}

/// What a reference is worth, in words.
std::string reference_note(const ReportModel& model) {
  std::vector<double> uncertainty_m;
  for (const StepError& error : model.errors) {
    uncertainty_m.push_back(error.uncertainty_m);
  }
  const double median_m = quantile(uncertainty_m, 0.5);
  if (median_m <= 0.0) {
    return "The reference is exact (no uncertainty stated). ";
  }
  return "The reference is no ground truth: its own uncertainty is " + with_unit(median_m, "m") +
         " (median, 1&#963;); differences below that say little. ";
}

std::string explanation(const ReportModel& model) {
  if (!model.has_reference()) {
    return "Nothing here tells whether the estimate is right; the figures are what the filter "
           "itself states.";
  }
  std::string text = reference_note(model);
  if (model.summary.first_loss_s) {
    text += "First lost after " + duration(*model.summary.first_loss_s) + ". ";
  }
  return text + "Metres in a drawing are pixels divided by the local scale of the reference.";
}

std::string css_class(Verdict::Kind kind) {
  switch (kind) {
    case Verdict::Kind::Located:
      return "located";
    case Verdict::Kind::Partly:
      return "partly";
    case Verdict::Kind::Lost:
      return "lost";
    case Verdict::Kind::Unknown:
      return "unknown";
  }
  return "unknown";
}

std::string row(const std::string& name, const std::string& value) {
  return "<tr><th scope=\"row\">" + name + "</th><td>" + value + "</td></tr>";
}

std::string summary_row(const std::string& name, const ErrorSummary& summary, int decimals) {
  std::string html = "<tr><th scope=\"row\">" + name + "</th>";
  for (const double value :
       {summary.mean, summary.median, summary.rmse, summary.p90, summary.max}) {
    html += "<td>" + fixed(value, decimals) + "</td>";
  }
  return html + "</tr>";
}

std::string error_table(const SketchErrors& errors) {
  return "<div class=\"scroll\"><table><thead><tr><th></th><th>mean</th><th>median</th>"
         "<th>RMSE</th><th>90&#160;%</th><th>max</th></tr></thead><tbody>" +
         summary_row("position, m", *errors.translation_m, 2) +
         summary_row("position, px", *errors.translation_px, 0) +
         summary_row("heading, &#176;", scaled(*errors.heading_rad, deg_from_rad(1.0)), 1) +
         "</tbody></table></div>";
}

std::string nees_text(const NeesSummary& nees) {
  const double ratio = nees.mean / nees.degrees;
  const char* meaning = ratio > 1.5   ? "too sure of itself"
                        : ratio < 0.5 ? "more careful than needed"
                                      : "about honest";
  return fixed(nees.mean, 1) + " (honest: " + fixed(nees.degrees, 0) + "), " +
         percent(nees.share_inside) + " inside the 95&#160;% region: " + meaning;
}

std::string error_rows(const ReportModel& model) {
  const SketchErrors& errors = model.summary;
  const LossDefinition& loss = model.record.loss;
  std::string html =
      row("scored steps", fixed(static_cast<double>(errors.scored), 0)) +
      row("within 1 m / 2 m",
          percent(errors.share_within_1_m) + " / " + percent(errors.share_within_2_m)) +
      (errors.share_within_uncertainty
           ? row("within 2&#963; of the reference", percent(*errors.share_within_uncertainty))
           : std::string()) +
      row("first lost (" + short_number(loss.bound_m) + " m off for " +
              short_number(loss.lasting_m) + " m of driving)",
          errors.first_loss_s ? "after " + duration(*errors.first_loss_s) : "never") +
      row("lost at the end", errors.lost_at_end ? "yes" : "no") +
      row("estimated / reference scale, median", fixed(errors.median_scale_ratio, 2));
  if (errors.position_nees) {
    html += row("position NEES", nees_text(*errors.position_nees));
  }
  return html;
}

std::string run_rows(const RunRecord& record) {
  std::string html;
  for (const NamedText& input : record.inputs) {
    html += row(escaped(input.name), escaped(input.text));
  }
  html += row("poses", fixed(static_cast<double>(record.steps.size()), 0)) +
          row("seed", std::to_string(record.seed)) + row("commit", escaped(record.commit));
  if (record.cost) {
    html += row("computing time", duration(record.cost->seconds)) +
            row("peak memory", fixed(record.cost->peak_memory_mb, 0) + "&#160;MB");
  }
  return html;
}

}  // namespace

std::string verdict_html(const ReportModel& model) {
  const Verdict verdict = judge(model.summary, model.record.loss.bound_m);
  return "<section class=\"verdict " + css_class(verdict.kind) + "\"><h2>" + verdict.headline +
         "</h2><div class=\"tiles\">" +
         (model.has_reference() ? error_tiles(model.summary) : stated_tiles(model.record)) +
         "</div><p class=\"note\">" + explanation(model) + "</p></section>";
}

std::string tables_html(const ReportModel& model) {
  std::string html = "<section><h2>Figures</h2>";
  if (model.has_reference()) {
    html += error_table(model.summary);
  }
  html += "<table class=\"facts\"><tbody>" +
          (model.has_reference() ? error_rows(model) : std::string()) + run_rows(model.record) +
          "</tbody></table>";
  if (!model.record.parameters.empty()) {
    html += "<details><summary>Parameters</summary><pre>" + escaped(model.record.parameters) +
            "</pre></details>";
  }
  return html + "</section>";
}

}  // namespace sketchloc::detail
