#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "topology/travel.hpp"

namespace sketchloc {

/// What counts as driving straight on.
struct StraightParams {
  double window_m = 1.0;      ///< of way around a pose, in which the heading is looked at, > 0
  double most_turn_deg = 15;  ///< in such a window and in a whole piece, 1 to 44
  double shortest_m = 0.6;    ///< of a piece, > 0
  double longest_m = 3.0;     ///< more than this becomes several pieces, at least shortest_m
};
void validate(const StraightParams& params);

template <typename Visitor>
void visit_fields(StraightParams& params, Visitor&& visit) {
  visit("window_m", params.window_m);
  visit("most_turn_deg", params.most_turn_deg);
  visit("shortest_m", params.shortest_m);
  visit("longest_m", params.longest_m);
}

/// Poses between which a robot drove straight on: in a building with right angles its direction is
/// that of a wall, up to quarter turns.
struct StraightPiece {
  std::size_t first = 0;  ///< pose
  std::size_t last = 0;   ///< pose, included
  double way_m = 0.0;     ///< of its middle, since the first pose of the run
  double length_m = 0.0;
  /// Direction of the chord in the odometry's frame; with a robot that drives backwards that of the
  /// way it looks. Unwrapped, beside the robot's heading.
  double axis_rad = 0.0;
};

/// In the order of the way. Pieces do not overlap.
std::vector<StraightPiece> straight_pieces(std::span<const Se2> odom_from_robot,
                                           const Travel& travel, const StraightParams& params = {});

}  // namespace sketchloc
