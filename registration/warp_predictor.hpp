#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "motion/sim2.hpp"
#include "registration/local_window.hpp"
#include "registration/scan_raster.hpp"
#include "registration/sketch_crop.hpp"
#include "registration/warp.hpp"

namespace sketchloc {

/// Errors of registrations have long tails: where walls look alike, a good one is far off. They are
/// told as a Student t with so many degrees of freedom: held-out errors have 3 to 6.
inline constexpr int kErrorDegrees = 4;

/// How what a robot sees lies in a drawing, as somebody who looked at both says.
struct Registration {
  Warp warp;
  LocalWindow window{};    ///< whose contents the warp is made of; beyond it the warp guesses
  Sim2 sketch_from_robot;  ///< the robot's pose
  /// Of the pose's error e in truth = sketch_from_robot * e: (x m, y m, heading rad, log scale) of
  /// e, a Student t with kErrorDegrees around 0. None where the predictor does not know.
  std::optional<Eigen::Matrix4d> covariance;
  double inlier_probability = 1.0;  ///< that the pose is right at all, in [0, 1]
  /// Log odds that the robot is there and nowhere else (registration/verified_predictor.hpp); none:
  /// nobody looked.
  std::optional<double> place_log_odds = std::nullopt;
};

/// Registers scans in drawings from prior poses.
class WarpPredictor {
 public:
  virtual ~WarpPredictor() = default;

  /// One result for each prior, in their order; none where the predictor has no use for what it
  /// found (a warp that folds at the robot). `submap` is not empty; the present scan comes first.
  virtual std::vector<std::optional<Registration>> predict(
      std::span<const PlacedScan> submap, const SketchCropper& drawing,
      std::span<const Sim2> priors_sketch_from_robot) = 0;

 protected:
  WarpPredictor() = default;
  WarpPredictor(const WarpPredictor&) = default;
  WarpPredictor& operator=(const WarpPredictor&) = default;
};

}  // namespace sketchloc
