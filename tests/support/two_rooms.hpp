#pragma once

#include <vector>

#include "datasets/scan.hpp"
#include "datasets/sketch.hpp"
#include "motion/se2.hpp"
#include "motion/sim2.hpp"
#include "registration/warp_predictor.hpp"

namespace sketchloc::testing {

/// Of two_rooms.
inline constexpr double kPxPerM = 20.0;

/// Two rooms of different size with a door between them, drawn in true proportions.
Sketch two_rooms();

struct Drive {
  std::vector<Sim2> sketch_from_robot;
  std::vector<Se2> odom_from_robot;
  std::vector<Scan> scans;  ///< at 0, 1, 2, ... s
};

/// From the left room through the door into the right one; 1 cm of noise on the ranges.
Drive drive_through_the_door(const Sketch& sketch);

/// Finds every pose as the drive has it.
class KnowsTheWay final : public WarpPredictor {
 public:
  explicit KnowsTheWay(const Drive& drive) : drive_(drive) {}

  std::vector<std::optional<Registration>> predict(std::span<const PlacedScan> submap,
                                                   const SketchCropper&,
                                                   std::span<const Sim2> priors) override;

  int looks = 0;

 private:
  const Drive& drive_;
};

}  // namespace sketchloc::testing
