#pragma once

#include <string>

#include "eval/navigation.hpp"

namespace sketchloc {

/// `report.html` of a drive: one self-contained page. The picture of the whole drive comes first
/// and needs no script; below it the drive plays back, scan by scan.
std::string drive_html(const NavigationTask& task, const NavigationTrial& trial,
                       const NavigationParams& params);

}  // namespace sketchloc
