#include "eval/step_table.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>

namespace sketchloc {
namespace {

constexpr std::array<std::string_view, 23> kColumns = {"step",
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
                                                       "injected_share"};

constexpr int kFirstCovariance = 6;

using Row = std::array<double, kColumns.size()>;

/// The shortest text that reads back as the same number.
std::string text_of(double value) {
  std::array<char, 32> buffer;
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end.ptr};
}

Row row_of(const StepReport& report) {
  const Sim2& pose = report.estimate.sketch_from_robot;
  Row row{static_cast<double>(report.step),
          report.time_s,
          pose.x(),
          pose.y(),
          pose.yaw_rad(),
          pose.scale()};
  std::size_t next = kFirstCovariance;
  for (int i = 0; i < 4; ++i) {
    for (int j = i; j < 4; ++j) {
      row[next++] = report.estimate.covariance(i, j);
    }
  }
  const auto& modes = report.estimate.modes;
  row[next++] = modes.empty() ? 1.0 : modes.front().weight;
  row[next++] = static_cast<double>(modes.size());
  row[next++] = static_cast<double>(report.particles);
  row[next++] = report.effective_particles;
  row[next++] = report.updated ? 1.0 : 0.0;
  row[next++] = report.log_likelihood;
  row[next++] = report.injected_share;
  return row;
}

StepReport report_of(const Row& row) {
  StepReport report;
  report.step = static_cast<std::size_t>(row[0]);
  report.time_s = row[1];
  report.estimate.sketch_from_robot = Sim2::from_xy_yaw_scale(row[2], row[3], row[4], row[5]);
  std::size_t next = kFirstCovariance;
  for (int i = 0; i < 4; ++i) {
    for (int j = i; j < 4; ++j) {
      report.estimate.covariance(i, j) = report.estimate.covariance(j, i) = row[next++];
    }
  }
  report.estimate.modes = {{.sketch_from_robot = report.estimate.sketch_from_robot,
                            .covariance = report.estimate.covariance,
                            .weight = row[next]}};
  next += 2;  // the number of modes is for people
  report.particles = static_cast<std::size_t>(row[next++]);
  report.effective_particles = row[next++];
  report.updated = row[next++] != 0.0;
  report.log_likelihood = row[next++];
  report.injected_share = row[next++];
  return report;
}

[[noreturn]] void fail(const std::filesystem::path& csv, std::size_t line,
                       const std::string& what) {
  throw std::runtime_error(csv.string() + ":" + std::to_string(line) + ": " + what +
                           "; a trajectory.csv as sketchloc localize writes it is needed");
}

double number_in(std::string_view cell, std::string_view column, const std::filesystem::path& csv,
                 std::size_t line) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) {
    fail(csv, line, std::string(column) + ": expected a number, found '" + std::string(cell) + "'");
  }
  return value;
}

Row parse_row(std::string_view text, const std::filesystem::path& csv, std::size_t line) {
  Row row{};
  for (std::size_t i = 0; i < row.size(); ++i) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (i + 1 == row.size())) {
      fail(csv, line, "expected " + std::to_string(row.size()) + " columns");
    }
    row[i] = number_in(text.substr(0, comma), kColumns[i], csv, line);
    text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
  }
  return row;
}

std::string header() {
  std::string text;
  for (const std::string_view column : kColumns) {
    text.append(text.empty() ? "" : ",").append(column);
  }
  return text;
}

void check_row(const Row& row, const std::vector<StepReport>& before,
               const std::filesystem::path& csv, std::size_t line) {
  if (row[0] < 0.0 || row[0] != std::floor(row[0]) ||
      (!before.empty() && row[0] <= static_cast<double>(before.back().step))) {
    fail(csv, line, "step: expected whole numbers that increase, found " + text_of(row[0]));
  }
  if (!(row[5] > 0.0)) {
    fail(csv, line, "scale_px_per_m: expected more than 0, found " + text_of(row[5]));
  }
}

}  // namespace

std::string step_table_csv(std::span<const StepReport> steps) {
  std::string text = header() + "\n";
  for (const StepReport& report : steps) {
    std::string line;
    for (const double value : row_of(report)) {
      line.append(line.empty() ? "" : ",").append(text_of(value));
    }
    text += line + "\n";
  }
  return text;
}

std::vector<StepReport> read_step_table(const std::filesystem::path& csv) {
  std::ifstream file(csv);
  if (!file) {
    throw std::runtime_error(csv.string() + ": cannot be opened");
  }
  std::string line;
  if (!std::getline(file, line) || line != header()) {
    fail(csv, 1, "expected the header " + header().substr(0, 25) + "...");
  }
  std::vector<StepReport> steps;
  for (std::size_t number = 2; std::getline(file, line); ++number) {
    const Row row = parse_row(line, csv, number);
    check_row(row, steps, csv, number);
    steps.push_back(report_of(row));
  }
  return steps;
}

}  // namespace sketchloc
