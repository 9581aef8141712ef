#include "eval/step_table.hpp"

#include <array>
#include <limits>
#include <string_view>
#include <utility>

#include "datasets/io/csv_table.hpp"
#include "motion/number_text.hpp"

namespace sketchloc {
namespace {

constexpr std::array<std::string_view, 26> kColumns = {"step",
                                                       "time_s",
                                                       "x_px",
                                                       "y_px",
                                                       "heading_rad",
                                                       "scale_px_per_m",
                                                       "cov_x_x",
                                                       "cov_x_y",
                                                       "cov_x_heading",
                                                       "cov_x_log_scale",
                                                       "cov_y_y",
                                                       "cov_y_heading",
                                                       "cov_y_log_scale",
                                                       "cov_heading_heading",
                                                       "cov_heading_log_scale",
                                                       "cov_log_scale_log_scale",
                                                       "mode_weight",
                                                       "modes",
                                                       "particles",
                                                       "effective_particles",
                                                       "updated",
                                                       "log_likelihood",
                                                       "injected_share",
                                                       "localized_probability",
                                                       "challengers",
                                                       "found_anew"};

constexpr std::size_t kFirstCovariance = 6;

constexpr double kMost = 1e9;  ///< of positions and scales
constexpr double kMostAngle_rad = 1e6;
constexpr double kMostTime_s = 1e11;
constexpr double kMostNumber = std::numeric_limits<double>::max();  ///< anything but infinity

std::string line_of(const StepReport& report) {
  const Sim2& pose = report.estimate.sketch_from_robot;
  std::string line = number_text(report.step);
  const auto add = [&line](auto value) {
    line += ',';
    append_number(line, value);
  };
  for (const double value : {report.time_s, pose.x(), pose.y(), pose.yaw_rad(), pose.scale()}) {
    add(value);
  }
  for (int i = 0; i < 4; ++i) {
    for (int j = i; j < 4; ++j) {
      add(report.estimate.covariance(i, j));
    }
  }
  const auto& modes = report.estimate.modes;
  add(modes.empty() ? 1.0 : modes.front().weight);
  add(modes.size());
  add(report.particles);
  add(report.effective_particles);
  add(report.updated ? 1 : 0);
  add(report.log_likelihood);
  add(report.injected_share);
  add(report.localized_probability);
  add(report.challengers);
  add(report.found_anew ? 1 : 0);
  return line;
}

StepReport report_of(const CsvRow& row) {
  StepReport report;
  report.step = row.count("step");
  report.time_s = row.number("time_s", kMostTime_s);
  Estimate& estimate = report.estimate;
  estimate.sketch_from_robot = Sim2::from_xy_yaw_scale(
      row.number("x_px", kMost), row.number("y_px", kMost),
      row.number("heading_rad", kMostAngle_rad), row.above_zero("scale_px_per_m", kMost));
  std::size_t column = kFirstCovariance;
  for (int i = 0; i < 4; ++i) {
    for (int j = i; j < 4; ++j) {
      estimate.covariance(i, j) = estimate.covariance(j, i) =
          row.number(kColumns[column++], kMostNumber);
    }
  }
  row.count("modes");  // for people; only the first is in the file
  estimate.modes = {{.sketch_from_robot = estimate.sketch_from_robot,
                     .covariance = estimate.covariance,
                     .weight = row.within("mode_weight", 0.0, 1.0 + 1e-6)}};
  report.particles = row.count("particles");
  report.effective_particles = row.at_least_zero("effective_particles", kMostNumber);
  report.updated = row.flag("updated");
  report.log_likelihood = row.number("log_likelihood", kMostNumber);
  report.injected_share = row.within("injected_share", 0.0, 1.0);
  report.localized_probability = row.within("localized_probability", 0.0, 1.0);
  report.challengers = row.count("challengers");
  report.found_anew = row.flag("found_anew");
  return report;
}

std::string header() {
  std::string text;
  for (const std::string_view column : kColumns) {
    text.append(text.empty() ? "" : ",").append(column);
  }
  return text;
}

}  // namespace

std::string step_table_csv(std::span<const StepReport> steps) {
  std::string text = header() + "\n";
  for (const StepReport& report : steps) {
    text += line_of(report) + "\n";
  }
  return text;
}

std::vector<StepReport> read_step_table(const std::filesystem::path& csv) {
  std::vector<StepReport> steps;
  for_each_csv_row(csv, kColumns, [&](const CsvRow& row) {
    StepReport report = report_of(row);
    if (!steps.empty() && report.step <= steps.back().step) {
      row.fail("step", "more than " + std::to_string(steps.back().step),
               "a trajectory.csv as sketchloc localize writes it is needed");
    }
    steps.push_back(std::move(report));
  });
  return steps;
}

}  // namespace sketchloc
