#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "datasets/grid.hpp"
#include "motion/se2.hpp"
#include "registration/surface_points.hpp"

namespace sketchloc {

/// Exhaustive search for the heading and the shift of a scan. [Olson09]
struct PoseSearchParams {
  double cell_m = 0.1;             ///< shift step and cell of the look-up grid, > 0
  double heading_step_rad = 0.02;  ///< > 0
  double min_shift_m = 0.6;        ///< narrowest half window, > 0
  double max_shift_m = 1.0;        ///< widest half window, at least the narrowest
  double min_turn_rad = 0.5;       ///< narrowest half window, > 0
  double max_turn_rad = 0.8;       ///< widest half window, in [min_turn_rad, pi]
  double sigmas = 3.0;             ///< half window in sigmas of the prior between those, > 0
  double blur_m = 0.1;             ///< 1-sigma width of a surface in the grid, > 0
  double point_weight = 0.15;      ///< log-likelihood of one point on a surface, > 0; well below
                                   ///< its own because neighbours tell the same
  double candidate_gap_m = 0.25;   ///< candidates nearer than this and
  double candidate_gap_rad = 0.1;  ///< less turned than this count as one, > 0
  int max_candidates = 8;          ///< >= 1
};

template <typename Visitor>
void visit_fields(PoseSearchParams& params, Visitor&& visit) {
  visit("cell_m", params.cell_m);
  visit("heading_step_rad", params.heading_step_rad);
  visit("min_shift_m", params.min_shift_m);
  visit("max_shift_m", params.max_shift_m);
  visit("min_turn_rad", params.min_turn_rad);
  visit("max_turn_rad", params.max_turn_rad);
  visit("sigmas", params.sigmas);
  visit("blur_m", params.blur_m);
  visit("point_weight", params.point_weight);
  visit("candidate_gap_m", params.candidate_gap_m);
  visit("candidate_gap_rad", params.candidate_gap_rad);
  visit("max_candidates", params.max_candidates);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const PoseSearchParams& params);

/// A pose with the log-posterior that the search gave it.
struct PoseCandidate {
  Se2 odom_from_robot;
  double score = 0.0;
};

/// The surfaces of a submap, blurred: how well a point lies on one, 0..255 per cell. Wide enough
/// around them for a search: a point outside of the border finds no surface however it is shifted.
class SurfaceGrid {
 public:
  /// Throws std::invalid_argument if a parameter is out of range.
  explicit SurfaceGrid(const PoseSearchParams& params = {});

  void refill(std::span<const SurfacePoint> points_in_odom);

  bool empty() const { return cells_.empty(); }
  const Grid<std::uint8_t>& cells() const { return cells_; }
  /// The cell of a point; none outside of the border.
  std::optional<Cell> cell_of(const Eigen::Vector2d& point_in_odom) const;

 private:
  PoseSearchParams params_;
  Eigen::Vector2d low_corner_in_odom_ = Eigen::Vector2d::Zero();
  int border_cells_ = 0;
  Grid<std::uint8_t> cells_;
};

/// Scores every heading and shift around a prior pose; keeps its buffers between searches.
class PoseSearch {
 public:
  /// Throws std::invalid_argument if a parameter is out of range.
  explicit PoseSearch(const PoseSearchParams& params = {});

  /// The best local maxima, best first; at least one unless the grid or the scan
  /// is empty. The grid must have the same parameters. Sigma: (x m, y m, yaw rad) of the prior in
  /// the robot frame.
  std::vector<PoseCandidate> search(std::span<const SurfacePoint> points_in_robot,
                                    const SurfaceGrid& surfaces, const Se2& prior_odom_from_robot,
                                    const Eigen::Vector3d& prior_sigma);

 private:
  void add_up(std::span<const SurfacePoint> points_in_robot, const SurfaceGrid& surfaces,
              const Se2& odom_from_robot, int half_window);

  void collect_peaks(const Se2& odom_from_robot, double heading_cost,
                     const Eigen::Vector2d& prior_sigma_m, int half_window);

  PoseSearchParams params_;
  // Of one heading, one per shift, row by row:
  std::vector<std::uint32_t> sums_;
  std::vector<double> scores_;
  std::vector<PoseCandidate> peaks_;  // of all headings
};

}  // namespace sketchloc
