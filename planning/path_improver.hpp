#pragma once

#include "motion/random.hpp"
#include "planning/path.hpp"

namespace sketchloc {

/// Makes a way better, a little at a time and never worse: tries shortcuts between any two of its
/// places, and other places for its corners; takes what is free and costs less. Every way between
/// is whole, so one may stop at any time.
class PathImprover {
 public:
  /// The way has at least two points and is free. The space must outlive the improver.
  PathImprover(const FreeSpace& space, PathPoints path_in_sketch, Rng rng);

  /// One try; whether the way became better.
  bool improve();

  const PathPoints& path_in_sketch() const { return path_; }
  double cost_m() const;

 private:
  bool cut_short();
  bool move_corner();
  void split_long_sides();
  void replace(std::size_t first, std::size_t last, const PathPoints& points);
  double side_cost_m(std::size_t first) const { return side_cost_m_[first]; }

  const FreeSpace& space_;
  PathPoints path_;
  std::vector<double> side_cost_m_;  ///< of the side that begins at each corner but the last
  Rng rng_;
  double move_px_;
};

}  // namespace sketchloc
