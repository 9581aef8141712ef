#pragma once

#include <filesystem>

#include "motion/trajectory.hpp"

namespace sketchloc {

/// The first poses of the FLASER lines of a CARMEN log, plain or gzip: where a mapper has corrected
/// the log, its answer. A reference for evaluation, never an input. Times must not decrease, as in
/// read_run; of scans at one time the first counts. Throws std::runtime_error with file, line and
/// field.
MetricTrajectory read_corrected_poses(const std::filesystem::path& log);

}  // namespace sketchloc
