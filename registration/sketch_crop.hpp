#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "datasets/grid.hpp"
#include "datasets/sketch.hpp"
#include "motion/sim2.hpp"
#include "registration/local_window.hpp"
#include "registration/ray_caster.hpp"

namespace sketchloc {

/// A drawing around a prior, on the cells of a window that lies in it as the prior says.
struct SketchCrop {
  /// Stroke in a cell: the ink's area over that of a line one pixel wide across the cell, at most
  /// 1, shared out between cells as a scan's end points are. Thin lines never vanish.
  Grid<float> strokes;
  /// 1 on a stroke, falling linearly to 0 at kNearnessReach_cells.
  Grid<float> nearness;
  /// What a scan of the full turn would see from the prior, if the drawing were true.
  Grid<float> visible_free;

  static constexpr double kNearnessReach_cells = 8.0;
};

/// Cuts crops out of one drawing; immutable after construction, safe to share between threads.
class SketchCropper {
 public:
  /// Anything but zero is a stroke.
  explicit SketchCropper(const Grid<std::uint8_t>& occupied);

  /// Where free space was painted, its outline is the strokes.
  explicit SketchCropper(const Sketch& sketch);

  /// Turned and scaled by the prior, so that scan and crop overlay where the prior is right and the
  /// drawing is true.
  SketchCrop crop(const Sim2& sketch_from_robot, const LocalWindow& window) const;

  /// The crop of [Chen20]: an upright square of the drawing around a point, 1 in cells with ink.
  Grid<float> upright_crop(const Eigen::Vector2d& centre_in_sketch, double side_px,
                           int cells) const;

  /// How far a stroke is from a point. Bilinear; beyond the outermost pixel centres the way there
  /// is added.
  float distance_px(const Eigen::Vector2f& point_in_sketch) const;

  /// The centres of the pixels with ink that are no farther than this from a point, row by row.
  std::vector<Eigen::Vector2d> ink_near(const Eigen::Vector2d& point_in_sketch,
                                        double radius_px) const;

 private:
  template <typename Visit>
  void for_each_ink(const Sim2& cells_from_sketch, int cells, Visit&& visit) const;
  Grid<float> strokes(const Sim2& cells_from_sketch, int cells) const;
  Grid<float> nearness(const Sim2& cells_from_sketch, int cells) const;
  Grid<float> visible_free(const Sim2& sketch_from_robot, const LocalWindow& window) const;

  std::vector<std::size_t> row_starts_;  ///< into ink_columns_, one per row and the end
  std::vector<int> ink_columns_;         ///< of the pixels with ink, row by row
  Grid<float> distance_px_;
  RayCaster caster_;
};

}  // namespace sketchloc
