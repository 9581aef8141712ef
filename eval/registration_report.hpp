#pragma once

#include <span>
#include <string>

#include "eval/registration_picture.hpp"
#include "eval/registration_result.hpp"

namespace sketchloc {

/// `report.html` of one registration: the picture, what it shows, the figures; self-contained as
/// report_html() (eval/report.hpp).
std::string registration_html(const RegistrationView& view, const RegistrationResult& result,
                              std::span<const NamedText> inputs);

}  // namespace sketchloc
