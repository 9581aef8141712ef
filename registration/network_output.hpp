#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "motion/sim2.hpp"
#include "registration/control_grid.hpp"
#include "registration/local_window.hpp"
#include "registration/warp.hpp"

namespace sketchloc {

/// Numbers that a residual network gives, in this order. Frame of the prior: the robot frame as the
/// prior believes it to lie in the drawing. Lengths are in units of unit_m(window) by the prior's
/// scale, so that one network can look through windows of any size.
struct ResidualOutput {
  static constexpr int kControlShift = 0;  ///< x, y of 16 control points: their place minus them
  static constexpr int kPose = 2 * kControls;   ///< x, y, heading rad, log scale
  static constexpr int kWhitening = kPose + 4;  ///< see whitening
  static constexpr int kInlierLogit = kWhitening + 10;
  static constexpr int kSize = kInlierLogit + 1;

  /// What limits the logarithms of the whitening's diagonal.
  static constexpr double kMaxLogPrecision = 6.0;
  static constexpr double kMinLogPrecision = -3.0;
};

/// The pitch of the features that a residual network matches: four cells of its input.
constexpr double unit_m(const LocalWindow& window) { return 4.0 * window.side_m / window.cells; }

/// Numbers that the published network gives, and its affine sister: for a 4x4 grid over the crop
/// the sources in the scan image, x, y, ... in [-1, 1] [Chen20]; or the six of source = A target +
/// b, rows of (A | b), with targets in [-1, 1] over the crop.
struct PublishedOutput {
  static constexpr int kSplineSize = 2 * kControls;
  static constexpr int kAffineSize = 6;
};

/// The pose that a residual network means.
Sim2 pose_of_residual(std::span<const float> output, const Sim2& prior_sketch_from_robot,
                      const LocalWindow& window);

/// Lower triangular W with covariance (W^T W)^-1 of (x, y, heading, log scale) in the frame of the
/// prior, lengths in units. Ten numbers: the logarithms of the diagonal, then the rest row by row.
Eigen::Matrix4d whitening_of_residual(std::span<const float> output);

/// The 32 sources that the affine numbers mean.
std::array<float, PublishedOutput::kSplineSize> sources_of_affine(std::span<const float> output);

/// The warp that a residual network means: its control points as it says, a spline between them.
Warp warp_of_residual(std::span<const float> output, const Sim2& prior_sketch_from_robot,
                      const LocalWindow& window);

/// Covariance of the error e in truth = pose * e, as of Registration, that a residual network
/// means.
Eigen::Matrix4d covariance_of_residual(std::span<const float> output, const LocalWindow& window);

/// That the pose is within 0.5 m and 15 deg, in (0, 1).
double inlier_probability_of_residual(std::span<const float> output);

/// The warp that published sources mean.
Warp warp_of_published(std::span<const float> sources, const Eigen::Vector2d& crop_centre_in_sketch,
                       const LocalWindow& window);

/// The pose that published sources mean: position, where the scan's centre lands in the drawing;
/// heading, where the line along the robot's heading points there; scale, sqrt(det) of the warp.
/// None where the warp has no such point or folds there.
std::optional<Sim2> pose_of_published(std::span<const float> sources,
                                      const Eigen::Vector2d& crop_centre_in_sketch,
                                      const LocalWindow& window);

}  // namespace sketchloc
