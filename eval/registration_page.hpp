#pragma once

#include <span>
#include <string>
#include <vector>

#include "eval/registration_summary.hpp"

namespace sketchloc {

/// One registration worth looking at.
struct RegistrationExample {
  std::string caption;
  std::string svg;  ///< of registration_svg()
};

/// What the page of a registration suite shows.
struct RegistrationPage {
  std::string title;
  std::string caption;  ///< how the questions were made
  std::vector<RegistrationRow> rows;
  std::vector<RegistrationDifference> differences;
  std::vector<RegistrationExample> typical;
  std::vector<RegistrationExample> worst;
};

/// One self-contained page: figures, error by prior error and by deformation, calibration,
/// pictures.
std::string registration_page_html(const RegistrationPage& page);

}  // namespace sketchloc
