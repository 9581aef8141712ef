#pragma once

#include "eval/run_record.hpp"

namespace sketchloc::testing {

/// How the estimate of a made-up run behaves.
enum class Outcome {
  Located,    ///< stays near the reference
  Recovered,  ///< is elsewhere for a while in the middle
  Lost        ///< is elsewhere from the middle on
};

/// A made-up run through a made-up drawing of six rooms, for looking at reports. Not a simulation:
/// the estimate is the reference with errors painted on.
RunRecord make_synthetic_run(Outcome outcome);

}  // namespace sketchloc::testing
