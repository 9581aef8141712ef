#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "datasets/reference.hpp"
#include "eval/run_record.hpp"
#include "motion/sim2.hpp"
#include "registration/local_window.hpp"
#include "registration/warp_predictor.hpp"

namespace sketchloc {

/// How one pose in a drawing differs from another, in the metres of the other.
struct PoseDifference {
  double shift_m = 0.0;
  double turn_rad = 0.0;     ///< counter-clockwise from the other, in (-pi, pi]
  double scale_ratio = 1.0;  ///< its scale over the other's
};
PoseDifference difference(const Sim2& sketch_from_robot, const Sim2& other_sketch_from_robot);

/// 1-sigma that the covariance of a Registration states.
struct PoseSigma {
  double position_m = 0.0;  ///< along the worst direction
  double heading_rad = 0.0;
};
PoseSigma sigma_of(const Eigen::Matrix4d& covariance);

/// One scan that was registered in a drawing, with what is told about it.
struct RegistrationResult {
  std::size_t step = 0;   ///< index of the scan in the run
  double time_s = 0.0;    ///< of the scan
  std::size_t scans = 1;  ///< that were looked at together, this one included
  LocalWindow window;     ///< that was looked at; the last one, of several
  Sim2 prior_sketch_from_robot;
  std::optional<Registration> registration;  ///< none: nothing was found
  double alignment = 0.0;                    ///< alignment_score of its warp
  double milliseconds = 0.0;                 ///< that registering took, without reading
  std::optional<ReferencePose> reference = std::nullopt;  ///< of the scan
};

/// Where the warp may fold in the window, looked at on a lattice of half metres or finer.
FoldReport find_folds(const Warp& warp, const LocalWindow& window);

/// `registration.json`, as docs/formats.md describes it.
std::string to_json(const RegistrationResult& result, std::span<const NamedText> inputs);

}  // namespace sketchloc
