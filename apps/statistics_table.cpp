#include "apps/statistics_table.hpp"

#include <cmath>
#include <functional>
#include <iomanip>
#include <sstream>
#include <vector>

#include "motion/angles.hpp"

namespace sketchloc {
namespace {

using Figure = std::function<double(const MeasuredDrawing&)>;

/// A figure of a drawing, by name.
struct NamedFigure {
  std::string name;
  Figure figure;
};

std::vector<NamedFigure> distortion_figures() {
  using Statistics = DrawingStatistics;
  const auto of = [](auto figure) {
    return [figure](const MeasuredDrawing& one) { return figure(one.distortion); };
  };
  std::vector<NamedFigure> figures = {
      {"scale, median, px/m", of([](const Statistics& one) { return one.scale_px_per_m.median; })},
      {"scale, 95 % over 5 %",
       of([](const Statistics& one) { return one.scale_px_per_m.p95 / one.scale_px_per_m.p5; })},
      {"rotation, 5 % to 95 %, deg", of([](const Statistics& one) {
         return deg_from_rad(one.rotation_rad.p95 - one.rotation_rad.p5);
       })},
      {"anisotropy, median", of([](const Statistics& one) { return one.anisotropy.median; })},
      {"anisotropy, 95 %", of([](const Statistics& one) { return one.anisotropy.p95; })},
      {"residual, RMS, m", of([](const Statistics& one) { return one.residual_rms_m; })}};
  for (std::size_t i = 0; i < Statistics::kLags_m.size(); ++i) {
    std::ostringstream name;
    name << "residual change over " << Statistics::kLags_m[i] << " m, m";
    figures.push_back(
        {name.str(), of([i](const Statistics& one) { return one.residual_change_m[i]; })});
  }
  return figures;
}

std::vector<NamedFigure> agreement_figures() {
  const auto of = [](double ScanAgreement::*figure) {
    return [figure](const MeasuredDrawing& one) { return one.agreement.*figure; };
  };
  return {{"log range ratio, median", of(&ScanAgreement::median_log_ratio)},
          {"log range ratio, lower quartile", of(&ScanAgreement::log_ratio_p25)},
          {"log range ratio, upper quartile", of(&ScanAgreement::log_ratio_p75)},
          {"beams within 0.1", of(&ScanAgreement::share_within_0_1)},
          {"beams within 0.3", of(&ScanAgreement::share_within_0_3)},
          {"beams within 0.6", of(&ScanAgreement::share_within_0_6)},
          {"beams short, below -0.6", of(&ScanAgreement::share_short)},
          {"beams long, above 0.6", of(&ScanAgreement::share_long)},
          {"end points within 0.5 m of a stroke", of(&ScanAgreement::share_near_stroke)},
          {"the same, scans mirrored", of(&ScanAgreement::share_near_stroke_mirrored)}};
}

/// Drawings that do not have the figure (NaN) are left out.
std::vector<double> values_of(const Figure& figure, std::span<const MeasuredDrawing> drawings) {
  std::vector<double> values;
  for (const MeasuredDrawing& drawing : drawings) {
    const double value = figure(drawing);
    if (!std::isnan(value)) {
      values.push_back(value);
    }
  }
  return values;
}

void append_lines(std::ostream& table, const std::vector<NamedFigure>& figures,
                  std::span<const MeasuredDrawing> drawings) {
  for (const auto& [name, figure] : figures) {
    std::vector<double> values = values_of(figure, drawings);
    table << "| " << name;
    if (values.empty()) {
      table << " | - | - | - |\n";
      continue;
    }
    const Quantiles over_drawings = quantiles(std::move(values));
    table << " | " << over_drawings.p5 << " | " << over_drawings.median << " | "
          << over_drawings.p95 << " |\n";
  }
}

}  // namespace

std::string statistics_table(std::span<const MeasuredDrawing> drawings) {
  std::ostringstream table;
  table << std::fixed << std::setprecision(2);
  table << "| " << drawings.size()
        << " drawings | 5 % | median | 95 % |\n| --- | --- | --- | --- |\n";
  append_lines(table, distortion_figures(), drawings);
  append_lines(table, agreement_figures(), drawings);
  return table.str();
}

std::string agreement_table(const ScanAgreement& agreement) {
  std::ostringstream table;
  table << std::fixed << std::setprecision(2) << "| " << agreement.returns
        << " returns | value |\n| --- | --- |\n";
  for (const auto& [name, figure] : agreement_figures()) {
    table << "| " << name << " | " << figure({.distortion = {}, .agreement = agreement}) << " |\n";
  }
  return table.str();
}

}  // namespace sketchloc
