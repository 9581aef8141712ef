#pragma once

#include <optional>
#include <span>
#include <string>

#include "eval/localization.hpp"
#include "eval/predictors.hpp"

namespace sketchloc {

/// A way to find a robot as people name it: what finds it, and what registers scans for that.
struct LocalizationMethod {
  std::string name;
  Method method = Method::Mcl;
  std::optional<RegistrationMethod> registration;
  bool propose = false;
  bool measure = false;
  Smoothing smoothing = Smoothing::None;
};

/// All that there are: `odometry`; one registration after the other as in [Chen20] by `icp`,
/// `affine`, `chen20` and ours (`ours_chained`); the filter alone (`mcl`), helped by registrations
/// of ours in its measurement (`mcl+measure`), its proposal (`mcl+propose`), or both (`ours`), and
/// that smoothed with a lag (`ours+lag`) or after the run (`ours+smooth`).
std::span<const LocalizationMethod> localization_methods();

/// One of them. Throws std::invalid_argument with the names that there are.
const LocalizationMethod& localization_method(const std::string& name);

/// The parameters without what the method goes without.
LocalizerParams params_of(const LocalizationMethod& method, const LocalizerParams& params);

}  // namespace sketchloc
