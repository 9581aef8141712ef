#pragma once

#include <cstddef>

#include "filter/estimate.hpp"

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
};

}  // namespace sketchloc
