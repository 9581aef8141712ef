#include "registration/pose_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "motion/validate.hpp"

namespace sketchloc {
namespace {

constexpr double kFullScore = 255.0;

struct Stamp {
  int radius = 0;
  std::vector<std::uint8_t> values;  // (2 radius + 1)^2, row by row
};

Stamp gaussian_stamp(double sigma_cells) {
  Stamp stamp{.radius = static_cast<int>(std::ceil(2.5 * sigma_cells)), .values = {}};
  for (int row = -stamp.radius; row <= stamp.radius; ++row) {
    for (int column = -stamp.radius; column <= stamp.radius; ++column) {
      const double square = (row * row + column * column) / (sigma_cells * sigma_cells);
      stamp.values.push_back(
          static_cast<std::uint8_t>(std::lround(kFullScore * std::exp(-0.5 * square))));
    }
  }
  return stamp;
}

/// The brightest of what is there and the stamp; the caller keeps the stamp inside the grid.
void press(const Stamp& stamp, const Cell& centre, Grid<std::uint8_t>& grid) {
  const auto width = static_cast<std::size_t>(2 * stamp.radius + 1);
  for (std::size_t row = 0; row < width; ++row) {
    const auto cells = grid.row(centre.row - stamp.radius + static_cast<int>(row))
                           .subspan(static_cast<std::size_t>(centre.column - stamp.radius), width);
    for (std::size_t column = 0; column < width; ++column) {
      cells[column] = std::max(cells[column], stamp.values[row * width + column]);
    }
  }
}

int half_window_cells(double half_width_m, const PoseSearchParams& params) {
  const double clamped_m = std::clamp(half_width_m, params.min_shift_m, params.max_shift_m);
  return static_cast<int>(std::ceil(clamped_m / params.cell_m));
}

/// Cost of a squared Mahalanobis distance under a Cauchy-like density: wheels slip and stamps come
/// late more often than a Gaussian allows.
double heavy_tail(double square) { return std::log1p(0.5 * square); }

/// Whether a score of a square table is at least that of its neighbours.
bool is_peak(std::span<const double> scores, int width, int row, int column) {
  const auto score_at = [&](int r, int c) {
    return scores[static_cast<std::size_t>(r * width + c)];
  };
  for (int r = std::max(row - 1, 0); r <= std::min(row + 1, width - 1); ++r) {
    for (int c = std::max(column - 1, 0); c <= std::min(column + 1, width - 1); ++c) {
      if (score_at(r, c) > score_at(row, column)) {
        return false;
      }
    }
  }
  return true;
}

bool is_near(const Se2& a, const Se2& b, const PoseSearchParams& params) {
  const Se2 a_from_b = a.inverse() * b;
  return a_from_b.translation().norm() < params.candidate_gap_m &&
         std::abs(a_from_b.yaw_rad()) < params.candidate_gap_rad;
}

/// The best ones that are not near a better one.
std::vector<PoseCandidate> distinct(std::vector<PoseCandidate> candidates,
                                    const PoseSearchParams& params) {
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [](const PoseCandidate& a, const PoseCandidate& b) { return a.score > b.score; });
  std::vector<PoseCandidate> kept;
  for (const PoseCandidate& candidate : candidates) {
    const bool is_new = std::ranges::none_of(kept, [&](const PoseCandidate& better) {
      return is_near(better.odom_from_robot, candidate.odom_from_robot, params);
    });
    if (is_new) {
      kept.push_back(candidate);
    }
    if (kept.size() == static_cast<std::size_t>(params.max_candidates)) {
      break;
    }
  }
  return kept;
}

}  // namespace

void validate(const PoseSearchParams& params) {
  require_above("cell_m", params.cell_m, 0.0);
  require_above("heading_step_rad", params.heading_step_rad, 0.0);
  require_above("sigmas", params.sigmas, 0.0);
  require_above("min_shift_m", params.min_shift_m, 0.0);
  require_at_least("max_shift_m", params.max_shift_m, params.min_shift_m);
  require_above("min_turn_rad", params.min_turn_rad, 0.0);
  require_in_range("max_turn_rad", params.max_turn_rad, params.min_turn_rad, std::numbers::pi);
  require_above("blur_m", params.blur_m, 0.0);
  require_above("point_weight", params.point_weight, 0.0);
  require_above("candidate_gap_m", params.candidate_gap_m, 0.0);
  require_above("candidate_gap_rad", params.candidate_gap_rad, 0.0);
  require_at_least("max_candidates", params.max_candidates, 1.0);
}

SurfaceGrid::SurfaceGrid(const PoseSearchParams& params) : params_(params) { validate(params); }

std::optional<Cell> SurfaceGrid::cell_of(const Eigen::Vector2d& point_in_odom) const {
  const Cell cell = cell_at((point_in_odom - low_corner_in_odom_) / params_.cell_m);
  const bool inside = cell.column >= border_cells_ && cell.row >= border_cells_ &&
                      cell.column < cells_.width() - border_cells_ &&
                      cell.row < cells_.height() - border_cells_;
  return inside ? std::optional(cell) : std::nullopt;
}

void SurfaceGrid::refill(std::span<const SurfacePoint> points_in_odom) {
  if (points_in_odom.empty()) {
    cells_ = {};
    return;
  }
  Eigen::Vector2d low = points_in_odom.front().point;
  Eigen::Vector2d high = low;
  for (const SurfacePoint& surface : points_in_odom) {
    low = low.cwiseMin(surface.point);
    high = high.cwiseMax(surface.point);
  }
  const Stamp stamp = gaussian_stamp(params_.blur_m / params_.cell_m);
  // A window around the surfaces holds the points that a shift may bring onto one; a second one
  // keeps their shifts inside the grid.
  border_cells_ = half_window_cells(params_.max_shift_m, params_) + stamp.radius + 1;
  const int margin = 2 * border_cells_;
  low_corner_in_odom_ = low - Eigen::Vector2d::Constant(margin * params_.cell_m);
  const Eigen::Vector2d size = (high - low) / params_.cell_m;
  cells_ = Grid<std::uint8_t>(static_cast<int>(size.x()) + 1 + 2 * margin,
                              static_cast<int>(size.y()) + 1 + 2 * margin);
  for (const SurfacePoint& surface : points_in_odom) {
    press(stamp, cell_at((surface.point - low_corner_in_odom_) / params_.cell_m), cells_);
  }
}

PoseSearch::PoseSearch(const PoseSearchParams& params) : params_(params) { validate(params); }

void PoseSearch::add_up(std::span<const SurfacePoint> points_in_robot, const SurfaceGrid& surfaces,
                        const Se2& odom_from_robot, int half_window) {
  const int width = 2 * half_window + 1;
  sums_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(width), 0);
  for (const SurfacePoint& surface : points_in_robot) {
    const std::optional<Cell> cell = surfaces.cell_of(odom_from_robot * surface.point);
    if (!cell) {
      continue;
    }
    std::uint32_t* sum = sums_.data();
    for (int shift = -half_window; shift <= half_window; ++shift, sum += width) {
      const std::uint8_t* found =
          surfaces.cells().row(cell->row + shift).data() + (cell->column - half_window);
      for (int i = 0; i < width; ++i) {
        sum[i] += found[i];
      }
    }
  }
}

void PoseSearch::collect_peaks(const Se2& odom_from_robot, double heading_cost,
                               const Eigen::Vector2d& prior_sigma_m, int half_window) {
  const int width = 2 * half_window + 1;
  const Eigen::Matrix2d robot_from_odom_rotation = odom_from_robot.rotation_matrix().transpose();
  const auto shift_in_odom = [&](int row, int column) -> Eigen::Vector2d {
    return Eigen::Vector2d(column - half_window, row - half_window) * params_.cell_m;
  };
  scores_.resize(sums_.size());
  for (int row = 0; row < width; ++row) {
    for (int column = 0; column < width; ++column) {
      const Eigen::Vector2d shift_in_robot = robot_from_odom_rotation * shift_in_odom(row, column);
      const std::size_t i = static_cast<std::size_t>(row * width + column);
      scores_[i] = params_.point_weight * sums_[i] / kFullScore - heading_cost -
                   heavy_tail(shift_in_robot.cwiseQuotient(prior_sigma_m).squaredNorm());
    }
  }
  for (int row = 0; row < width; ++row) {
    for (int column = 0; column < width; ++column) {
      if (is_peak(scores_, width, row, column)) {
        const Eigen::Vector2d position = odom_from_robot.translation() + shift_in_odom(row, column);
        peaks_.push_back({Se2::from_xy_yaw(position.x(), position.y(), odom_from_robot.yaw_rad()),
                          scores_[static_cast<std::size_t>(row * width + column)]});
      }
    }
  }
}

std::vector<PoseCandidate> PoseSearch::search(std::span<const SurfacePoint> points_in_robot,
                                              const SurfaceGrid& surfaces,
                                              const Se2& prior_odom_from_robot,
                                              const Eigen::Vector3d& prior_sigma) {
  if (surfaces.empty() || points_in_robot.empty()) {
    return {};
  }
  const double half_turn_rad =
      std::clamp(params_.sigmas * prior_sigma.z(), params_.min_turn_rad, params_.max_turn_rad);
  const int half_steps = static_cast<int>(std::ceil(half_turn_rad / params_.heading_step_rad));
  const int half_window =
      half_window_cells(params_.sigmas * prior_sigma.head<2>().maxCoeff(), params_);
  peaks_.clear();
  for (int step = -half_steps; step <= half_steps; ++step) {
    const double turn_rad = step * params_.heading_step_rad;
    const Se2 turned = prior_odom_from_robot * Se2::from_xy_yaw(0.0, 0.0, turn_rad);
    add_up(points_in_robot, surfaces, turned, half_window);
    collect_peaks(turned, heavy_tail(std::pow(turn_rad / prior_sigma.z(), 2)),
                  prior_sigma.head<2>(), half_window);
  }
  return distinct(peaks_, params_);
}

}  // namespace sketchloc
