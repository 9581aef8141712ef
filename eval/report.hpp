#pragma once

#include <string>

#include "eval/run_record.hpp"

namespace sketchloc {

/// `report.html` of a run: one self-contained page, pictures first, readable on a phone, without
/// scripts and without anything loaded from elsewhere. Well-formed XML as well as HTML 5.
std::string report_html(const RunRecord& record);

}  // namespace sketchloc
