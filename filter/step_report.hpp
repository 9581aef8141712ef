#pragma once

#include <cstddef>
#include <optional>

#include "filter/estimate.hpp"
#include "filter/localized_belief.hpp"

namespace sketchloc {

/// What one step of the localizer did; one per scan, plain values.
struct StepReport {
  std::size_t step = 0;  ///< index of the scan in the run
  double time_s = 0.0;
  Estimate estimate;
  bool updated = false;         ///< false: the motion gate kept the scan out
  bool registered = false;      ///< registrations told where the particles may be
  bool looked = false;          ///< a registration was tried
  bool held_back = false;       ///< one was due, and the budget of the step did not allow it
  bool limited = false;         ///< fewer particles than called for: the budget allowed no more
  double log_likelihood = 0.0;  ///< per beam, weighted mean over the particles; 0 if not updated
  double effective_particles = 0.0;
  std::size_t particles = 0;
  bool resampled = false;
  double injected_share = 0.0;  ///< particles replaced by recovery, in [0, 1]
  /// That the pose is within LocalizedParams' bounds of the truth, in [0, 1].
  double localized_probability = 1.0;
  double share_within_bounds = 1.0;  ///< of the particles' weight, see share_within_bounds()
  std::optional<LocalizedSigns> signs = std::nullopt;  ///< of the tracked pose, where there are new
  double contradiction = 0.0;   ///< of this scan and the last one, see contradiction()
  std::size_t challengers = 0;  ///< other places followed by registrations
  bool found_anew = false;      ///< one of them took the tracked pose's place
};

}  // namespace sketchloc
