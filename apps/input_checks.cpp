#include "apps/input_checks.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "registration/ray_caster.hpp"

namespace sketchloc {
namespace {

constexpr std::array<Cell, 8> kAround = {
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// Clears the blob that a cell belongs to.
void erase_blob(Grid<std::uint8_t>& cells, const Cell& start) {
  std::vector<Cell> open{start};
  cells.at(start) = 0;
  while (!open.empty()) {
    const Cell from = open.back();
    open.pop_back();
    for (const Cell& offset : kAround) {
      const Cell cell = {from.column + offset.column, from.row + offset.row};
      if (cells.contains(cell) && cells.at(cell) != 0) {
        cells.at(cell) = 0;
        open.push_back(cell);
      }
    }
  }
}

std::size_t blobs_in(Grid<std::uint8_t> cells) {
  std::size_t blobs = 0;
  for (int row = 0; row < cells.height(); ++row) {
    for (int column = 0; column < cells.width(); ++column) {
      if (cells.at({column, row}) != 0) {
        erase_blob(cells, {column, row});
        ++blobs;
      }
    }
  }
  return blobs;
}

bool has_strokes_all_around(const RayCaster& caster, const Eigen::Vector2d& place,
                            double diagonal_px) {
  constexpr int kDirections = 20;
  constexpr int kGaps = 2;  // as the global start allows: a tenth
  int gaps = 0;
  for (int i = 0; i < kDirections; ++i) {
    const auto heading_rad = static_cast<float>(2.0 * std::numbers::pi * i / kDirections);
    const auto far_px = static_cast<float>(diagonal_px);
    gaps += caster.range(place, heading_rad, far_px) >= far_px ? 1 : 0;
  }
  return gaps <= kGaps;
}

/// Looks at places on a lattice.
bool encloses_free_space(const Sketch& sketch) {
  constexpr int kLattice = 40;
  const RayCaster caster(sketch.occupied);
  const double diagonal_px = std::hypot(sketch.width_px(), sketch.height_px());
  for (int row = 0; row < kLattice; ++row) {
    for (int column = 0; column < kLattice; ++column) {
      const Eigen::Vector2d place((column + 0.5) * sketch.width_px() / kLattice,
                                  (row + 0.5) * sketch.height_px() / kLattice);
      if (sketch.occupied.at(cell_at(place)) == 0 &&
          has_strokes_all_around(caster, place, diagonal_px)) {
        return true;
      }
    }
  }
  return false;
}

/// How many scans see something, and how the ranges lie to the laser's limit.
struct Sight {
  std::size_t seeing_scans = 0;
  std::size_t ranges = 0;
  std::size_t beyond = 0;
  double max_range_m = 0.0;
};

Sight sight_of(const Run& run) {
  Sight sight;
  for (const RunStep& step : run.steps) {
    bool sees = false;
    for (std::size_t beam = 0; beam < step.scan.ranges_m.size(); ++beam) {
      const bool counts = step.scan.is_in_reach_or_beyond(beam);
      sees = sees || step.scan.is_return(beam);
      sight.ranges += counts ? 1U : 0U;
      sight.beyond += counts && !step.scan.is_return(beam) ? 1U : 0U;
    }
    sight.seeing_scans += sees ? 1U : 0U;
    sight.max_range_m = step.scan.max_range_m;
  }
  return sight;
}

}  // namespace

std::vector<std::string> doubts_about(const Sketch& sketch) {
  constexpr std::size_t kManyBlobs = 1000;
  if (sketch.kind != Sketch::Kind::Strokes || sketch.px_per_m) {
    return {};
  }
  std::vector<std::string> doubts;
  if (const std::size_t blobs = blobs_in(sketch.occupied); blobs > kManyBlobs) {
    doubts.push_back(
        fmt::format("has {} separate strokes; is it a photo, text or noise? See with "
                    "sketchloc convert what is read as obstacles",
                    blobs));
  }
  if (!encloses_free_space(sketch)) {
    doubts.push_back(
        "has no place with strokes around it; close the outer walls, or see with sketchloc convert "
        "what is read as obstacles");
  }
  return doubts;
}

std::vector<std::string> doubts_about(const Run& run) {
  constexpr double kManyBeyond = 0.9;
  const Sight sight = sight_of(run);
  std::vector<std::string> doubts;
  if (!run.steps.empty() && sight.seeing_scans == 0) {
    doubts.push_back("no scan has a return, so that nothing tells where the robot is");
  }
  if (static_cast<double>(sight.beyond) > kManyBeyond * static_cast<double>(sight.ranges)) {
    doubts.push_back(
        fmt::format("{:.0f} % of the ranges lie at or beyond the largest one, {:g} m, and are no "
                    "returns; are they in mm instead of m, or is the limit wrong (--max-range-m)?",
                    100.0 * static_cast<double>(sight.beyond) / static_cast<double>(sight.ranges),
                    sight.max_range_m));
  }
  return doubts;
}

std::vector<std::string> doubts_about(const Reference& reference,
                                      std::span<const double> scan_times_s) {
  const auto in_run = static_cast<std::size_t>(std::ranges::count_if(
      reference.poses, [&](const ReferencePose& pose) { return pose.step < scan_times_s.size(); }));
  std::vector<std::string> doubts;
  if (in_run < scan_times_s.size()) {
    doubts.push_back(
        fmt::format("has poses for {} of the {} scans; the figures hold for those only", in_run,
                    scan_times_s.size()));
  }
  if (in_run < reference.poses.size()) {
    doubts.push_back(fmt::format("has {} poses for scans after the last one of the log, scan {}",
                                 reference.poses.size() - in_run, scan_times_s.size() - 1));
  }
  return doubts;
}

bool is_of_another_run(const Reference& reference, std::span<const double> scan_times_s) {
  constexpr double kRounding_s = 0.05;
  std::size_t same = 0;
  std::size_t other = 0;
  for (const ReferencePose& pose : reference.poses) {
    if (pose.step < scan_times_s.size()) {
      const double gap_s = std::abs(pose.time_s - scan_times_s[pose.step]);
      (gap_s <= kRounding_s ? same : other) += 1;
    }
  }
  return other > same;
}

}  // namespace sketchloc
