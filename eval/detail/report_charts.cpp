#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "eval/detail/chart.hpp"
#include "eval/detail/report_model.hpp"
#include "eval/detail/text.hpp"
#include "motion/angles.hpp"

namespace sketchloc::detail {
namespace {

constexpr Colour kMain{90, 60, 170};
constexpr Colour kSecond{0, 130, 150};

/// Seconds or, for long runs, minutes since the start.
struct TimeAxis {
  double seconds_per_unit = 1.0;
  double high = 1.0;
  std::string unit = "s";
};

TimeAxis time_axis(const ReportModel& model) {
  constexpr double kMinutesBeyond_s = 600.0;
  TimeAxis axis;
  if (model.record.steps.empty()) {
    return axis;
  }
  const double seconds = model.seconds_since_start(model.record.steps.back().time_s);
  if (seconds > kMinutesBeyond_s) {
    axis = {.seconds_per_unit = 60.0, .high = 1.0, .unit = "min"};
  }
  axis.high = seconds > 0.0 ? seconds / axis.seconds_per_unit : 1.0;
  return axis;
}

Chart empty_chart(const ReportModel& model, const std::string& title, const std::string& unit) {
  const TimeAxis axis = time_axis(model);
  Chart chart{.title = title, .unit = unit, .x_high = axis.high, .x_unit = axis.unit};
  for (const Moment& moment : model.moments) {
    const double time_s = model.record.steps[moment.index].time_s;
    chart.marks.push_back(
        {.x = model.seconds_since_start(time_s) / axis.seconds_per_unit, .letter = moment.letter});
  }
  return chart;
}

/// A curve over all steps.
Polyline over_steps(const ReportModel& model,
                    const std::function<double(const StepReport&)>& value) {
  const TimeAxis axis = time_axis(model);
  Polyline points;
  for (const StepReport& report : model.record.steps) {
    points.emplace_back(model.seconds_since_start(report.time_s) / axis.seconds_per_unit,
                        value(report));
  }
  return points;
}

/// A curve over the scored steps, broken where others lie between them.
Polyline over_errors(const ReportModel& model,
                     const std::function<double(const StepError&)>& value) {
  auto error = model.errors.begin();
  return over_steps(model, [&](const StepReport& report) {
    while (error != model.errors.end() && error->step < report.step) {
      ++error;
    }
    const bool scored = error != model.errors.end() && error->step == report.step;
    return scored ? value(*error) : std::numeric_limits<double>::quiet_NaN();
  });
}

double highest(const Polyline& points) {
  double high = 0.0;
  for (const Eigen::Vector2d& point : points) {
    high = point.allFinite() ? std::max(high, point.y()) : high;
  }
  return high;
}

Curve stated_band(const ReportModel& model) {
  return {.name = "stated uncertainty (2\xCF\x83)",
          .colour = kReferenceBlue,
          .points = over_steps(model,
                               [](const StepReport& report) {
                                 return 2.0 * stated_position_sigma_m(report.estimate);
                               }),
          .filled = true};
}

Chart position_chart(const ReportModel& model) {
  if (!model.has_reference()) {
    Chart chart = empty_chart(model, "Stated position uncertainty", "m");
    chart.curves = {stated_band(model)};
    fit_y_range(chart);
    chart.y_low = 0.0;
    return chart;
  }
  constexpr double kCut_m = 8.0;
  constexpr double kLeast_m = 3.0;
  Chart chart = empty_chart(model, "Position error", "m");
  const Polyline error = over_errors(model, [](const StepError& e) { return e.translation_m; });
  chart.curves = {stated_band(model), {.name = "error", .colour = kBad, .points = error}};
  const Polyline own = over_errors(model, [](const StepError& e) { return e.uncertainty_m; });
  if (highest(own) > 0.0) {
    chart.curves.push_back({.name = "uncertainty of the reference (1\xCF\x83)",
                            .colour = kGrey,
                            .points = own,
                            .dashed = true});
  }
  chart.guides = {{.y = 1.0, .label = "1 m"}, {.y = 2.0, .label = "2 m"}};
  chart.y_high = std::clamp(1.05 * highest(error), kLeast_m, kCut_m);
  if (highest(error) > kCut_m) {
    chart.caption = "Cut off at " + short_number(kCut_m) + " m" + "; the largest error is " +
                    with_unit(highest(error), "m") + ".";
  }
  return chart;
}

Chart heading_chart(const ReportModel& model) {
  constexpr double kLeast_deg = 20.0;
  Chart chart = empty_chart(model, "Heading error", "\xC2\xB0");
  chart.curves = {
      {.name = "error", .colour = kBad, .points = over_errors(model, [](const StepError& e) {
                                          return deg_from_rad(e.heading_rad);
                                        })}};
  chart.y_high = std::max(kLeast_deg, 1.05 * highest(chart.curves[0].points));
  return chart;
}

Chart scale_chart(const ReportModel& model) {
  Chart chart = empty_chart(model, "Local scale of the drawing", "px/m");
  if (model.has_reference()) {
    chart.curves.push_back({.name = "reference",
                            .colour = kReferenceBlue,
                            .points = over_errors(model,
                                                  [](const StepError& e) {
                                                    return e.translation_px > 0.0
                                                               ? e.translation_px / e.translation_m
                                                               : std::nan("");
                                                  }),
                            .dashed = true});
  }
  chart.curves.push_back({.name = "estimate",
                          .colour = kBad,
                          .points = over_steps(model, [](const StepReport& report) {
                            return report.estimate.sketch_from_robot.scale();
                          })});
  fit_y_range(chart);
  chart.y_low = 0.0;
  return chart;
}

Chart likelihood_chart(const ReportModel& model) {
  Chart chart = empty_chart(model, "Fit of the scan to the drawing", "mean log-likelihood");
  chart.curves = {{.name = "particles",
                   .colour = kMain,
                   .points = over_steps(model, [](const StepReport& report) {
                     return report.updated ? report.log_likelihood : std::nan("");
                   })}};
  std::erase_if(chart.curves[0].points,  // what the motion gate kept out leaves no gap
                [](const Eigen::Vector2d& point) { return !point.allFinite(); });
  fit_y_range(chart);
  return chart;
}

Chart particle_chart(const ReportModel& model) {
  Chart chart = empty_chart(model, "Particles", "number");
  chart.curves = {
      {.name = "particles",
       .colour = kSecond,
       .points = over_steps(
           model, [](const StepReport& report) { return static_cast<double>(report.particles); }),
       .filled = true},
      {.name = "effective number",
       .colour = kMain,
       .points =
           over_steps(model, [](const StepReport& report) { return report.effective_particles; })}};
  fit_y_range(chart);
  chart.y_low = 0.0;
  return chart;
}

bool any_particles(const RunRecord& record) {
  return std::ranges::any_of(record.steps,
                             [](const StepReport& report) { return report.particles > 0; });
}

bool any_injected(const RunRecord& record) {
  return std::ranges::any_of(record.steps,
                             [](const StepReport& report) { return report.injected_share > 0.0; });
}

Chart recovery_chart(const ReportModel& model) {
  Chart chart = empty_chart(model, "Recovery", "% of particles replaced");
  chart.curves = {{.name = "replaced",
                   .colour = kFair,
                   .points = over_steps(model, [](const StepReport& report) {
                     return 100.0 * report.injected_share;
                   })}};
  fit_y_range(chart);
  chart.y_low = 0.0;
  return chart;
}

}  // namespace

std::string charts_html(const ReportModel& model) {
  if (model.record.steps.empty()) {
    return {};
  }
  std::string charts;
  if (model.has_reference()) {
    charts += chart_html(heading_chart(model));
  }
  charts += chart_html(scale_chart(model));
  if (any_particles(model.record)) {
    charts += chart_html(likelihood_chart(model)) + chart_html(particle_chart(model));
  }
  if (any_injected(model.record)) {
    charts += chart_html(recovery_chart(model));
  }
  return "<section><h2>Over time</h2>" + chart_html(position_chart(model)) +
         "<div class=\"charts\">" + charts + "</div></section>";
}

}  // namespace sketchloc::detail
