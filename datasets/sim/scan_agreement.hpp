#pragma once

#include "datasets/reference.hpp"
#include "datasets/run.hpp"
#include "datasets/sketch.hpp"

namespace sketchloc {

/// How well scans fit a drawing where the robot truly is, with the local similarity alone: what a
/// measurement model has to live with. The same figures for simulated and real drawings.
struct ScanAgreement {
  std::size_t returns = 0;  ///< beams looked at; all else is NaN without any

  // Of log(measured range / range to the first stroke), the measured one in px by the local scale.
  double median_log_ratio = 0.0;
  double log_ratio_p25 = 0.0;
  double log_ratio_p75 = 0.0;
  double share_within_0_1 = 0.0;
  double share_within_0_3 = 0.0;
  double share_within_0_6 = 0.0;
  double share_short = 0.0;  ///< stopped well before the stroke (below -0.6): things not drawn
  double share_long = 0.0;   ///< went well beyond it (above 0.6): doors drawn shut, wrong sizes

  double share_near_stroke = 0.0;           ///< end points within 0.5 m of a stroke
  double share_near_stroke_mirrored = 0.0;  ///< the same with each scan mirrored: by chance alone
};

/// Looks at all returns between 0.1 m and 20 m at the scored poses of the reference.
ScanAgreement measure_agreement(const Sketch& sketch, const Run& run, const Reference& reference);

}  // namespace sketchloc
