#include "apps/statistics_table.hpp"

#include <cmath>
#include <functional>
#include <iomanip>
#include <sstream>
#include <vector>

#include "motion/angles.hpp"

namespace sketchloc {
namespace {

using Figure = std::function<double(const DrawingStatistics&)>;

/// One line; drawings that do not have the figure (NaN) are left out.
void append_line(std::ostream& table, const std::string& name, const Figure& figure,
                 std::span<const DrawingStatistics> drawings) {
  std::vector<double> values;
  for (const DrawingStatistics& drawing : drawings) {
    const double value = figure(drawing);
    if (!std::isnan(value)) {
      values.push_back(value);
    }
  }
  table << "| " << name;
  if (values.empty()) {
    table << " | - | - | - |\n";
    return;
  }
  const Quantiles over_drawings = quantiles(std::move(values));
  table << " | " << over_drawings.p5 << " | " << over_drawings.median << " | " << over_drawings.p95
        << " |\n";
}

}  // namespace

std::string statistics_table(std::span<const DrawingStatistics> drawings) {
  std::ostringstream table;
  table << std::fixed << std::setprecision(2);
  table << "| " << drawings.size()
        << " drawings | 5 % | median | 95 % |\n| --- | --- | --- | --- |\n";
  const auto line = [&](const std::string& name, const Figure& figure) {
    append_line(table, name, figure, drawings);
  };
  line("scale, median, px/m", [](const auto& one) { return one.scale_px_per_m.median; });
  line("scale, 95 % over 5 %",
       [](const auto& one) { return one.scale_px_per_m.p95 / one.scale_px_per_m.p5; });
  line("rotation, 5 % to 95 %, deg",
       [](const auto& one) { return deg_from_rad(one.rotation_rad.p95 - one.rotation_rad.p5); });
  line("anisotropy, median", [](const auto& one) { return one.anisotropy.median; });
  line("anisotropy, 95 %", [](const auto& one) { return one.anisotropy.p95; });
  line("residual, RMS, m", [](const auto& one) { return one.residual_rms_m; });
  for (std::size_t i = 0; i < DrawingStatistics::kLags_m.size(); ++i) {
    std::ostringstream name;
    name << "residual change over " << DrawingStatistics::kLags_m[i] << " m, m";
    line(name.str(), [i](const auto& one) { return one.residual_change_m[i]; });
  }
  return table.str();
}

}  // namespace sketchloc
