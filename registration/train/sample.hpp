#pragma once

#include <array>
#include <vector>

#include "motion/odometry.hpp"
#include "motion/random.hpp"
#include "motion/sim2.hpp"
#include "registration/control_grid.hpp"
#include "registration/network_input.hpp"
#include "registration/train/scene.hpp"
#include "registration/warp_predictor.hpp"

namespace sketchloc {

/// How wrong priors are. An error is drawn at full size, or at a size that is small with all parts
/// together: repeated registration starts from its own results.
struct PriorError {
  double max_shift_m = 3.0;       ///< uniform in a disc of this radius, >= 0
  double max_turn_rad = 0.785;    ///< uniform in +- this, in [0, pi]
  double log_scale_sigma = 0.25;  ///< >= 0
  double full_share = 0.5;        ///< of the priors whose error has full size, in [0, 1]
  double least_size = 0.05;       ///< the others' size, log-uniform from this to 1, in (0, 1]
  /// Of the priors that a network which learns already has improved, once or twice: the errors
  /// that it starts from when it looks again, through a finer window. In [0, 1].
  double improved_share = 0.5;
};

template <typename Visitor>
void visit_fields(PriorError& error, Visitor&& visit) {
  visit("max_shift_m", error.max_shift_m);
  visit("max_turn_rad", error.max_turn_rad);
  visit("log_scale_sigma", error.log_scale_sigma);
  visit("full_share", error.full_share);
  visit("least_size", error.least_size);
  visit("improved_share", error.improved_share);
}

/// Of which registrations it is learned whether the robot is there (draw_registered).
struct RegisteredParams {
  double elsewhere_share =
      0.6;                   ///< of the samples whose priors are anywhere on the drive, in [0, 1]
  int elsewhere_priors = 3;  ///< so many, of which the most promising registration is taken, >= 1
};

template <typename Visitor>
void visit_fields(RegisteredParams& registered, Visitor&& visit) {
  visit("elsewhere_share", registered.elsewhere_share);
  visit("elsewhere_priors", registered.elsewhere_priors);
}

/// What a sample shows.
struct SampleParams {
  double side_m = 16.0;           ///< of the window, > 0
  int cells = 64;                 ///< of the window per side, >= 16
  double ahead_m = 0.0;           ///< of the window's centre
  double min_fine_side_m = 6.5;   ///< of the window after an improved prior, log-uniform, > 0
  double max_fine_side_m = 12.0;  ///< >= min_fine_side_m
  double alone_share = 0.35;      ///< samples of one scan at a random heading, in [0, 1]
  int max_scans = 6;              ///< of a submap, >= 1
  double scan_spacing_m = 0.7;    ///< between scans of a submap, >= 0
  OdometryNoise submap_noise = {.slip_m_per_m = 0.02,
                                .slip_m_per_rad = 0.005,
                                .turn_rad_per_m = 0.005,
                                .turn_rad_per_rad = 0.01};
  PriorError prior{};
  RegisteredParams registered{};

  LocalWindow window() const { return {.side_m = side_m, .cells = cells, .ahead_m = ahead_m}; }
};

template <typename Visitor>
void visit_fields(SampleParams& sample, Visitor&& visit) {
  visit("side_m", sample.side_m);
  visit("cells", sample.cells);
  visit("ahead_m", sample.ahead_m);
  visit("min_fine_side_m", sample.min_fine_side_m);
  visit("max_fine_side_m", sample.max_fine_side_m);
  visit("alone_share", sample.alone_share);
  visit("max_scans", sample.max_scans);
  visit("scan_spacing_m", sample.scan_spacing_m);
  visit("submap_noise", sample.submap_noise);
  visit("prior", sample.prior);
  visit("registered", sample.registered);
}

/// Throw std::invalid_argument naming the field, its range and its value.
void validate(const PriorError& error);
void validate(const RegisteredParams& params);
void validate(const SampleParams& params);

inline constexpr int kGridPerSide = 20;  ///< of the points at which a warp is judged
inline constexpr int kGridPoints = kGridPerSide * kGridPerSide;

/// The points of the robot's plane at which warps have their control values, and at which they are
/// judged.
std::vector<Eigen::Vector2d> control_points_in_robot(const LocalWindow& window);
std::vector<Eigen::Vector2d> grid_points_in_robot(const LocalWindow& window);

/// What improves priors: networks that look once and twice.
struct ImprovingNetworks {
  WarpPredictor* once = nullptr;  ///< none: nothing does
  WarpPredictor* twice = nullptr;
};

/// One thing to learn: the input of a network and what is true there. The frame of the prior is the
/// robot frame as the prior believes it to lie in the drawing; lengths in it are in units of
/// unit_m(window) by the prior's scale, as in ResidualOutput.
struct Sample {
  std::vector<float> input;  ///< see network_input
  LocalWindow window{};
  /// Where each control point truly lies in the frame of the prior, minus the point; x, y, ...
  std::array<float, 2 * kControls> control_shift{};
  /// The same for the grid points; of those indoors only.
  std::array<float, 2 * kGridPoints> grid_shift{};
  std::array<float, kGridPoints> grid_weight{};  ///< 1 indoors, else 0
  /// [Chen20]: for a 4x4 grid over the upright crop, from where in the scan image each point comes;
  /// x, y, ... in [-1, 1] over the image.
  std::array<float, 2 * kControls> published_source{};
  std::array<float, 4>
      pose{};              ///< true pose in the frame of the prior: x, y, heading rad, log scale
  Sim2 sketch_from_robot;  ///< true pose
  Sim2 prior_sketch_from_robot;
};

/// The pose disturbed as priors are.
Sim2 draw_prior(const Sim2& sketch_from_robot, const PriorError& error, Rng& rng);

Sample draw_sample(const Scene& scene, const SampleParams& params, InputKind kind, Rng& rng,
                   const ImprovingNetworks& networks = {});

/// Something registered, of which to learn whether the robot is there: the prior is where a network
/// found the scans, from a prior near the truth or from anywhere in the building. Of the truth only
/// the pose is told.
Sample draw_registered(const Scene& scene, const SampleParams& params, Rng& rng,
                       const ImprovingNetworks& networks);

}  // namespace sketchloc
