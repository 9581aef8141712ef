#include "eval/localization_methods.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace sketchloc {

std::span<const LocalizationMethod> localization_methods() {
  using enum RegistrationMethod;
  static const std::array<LocalizationMethod, 11> kMethods = {
      {{.name = "odometry", .method = Method::Odometry, .registration = {}},
       {.name = "icp", .method = Method::Chained, .registration = Icp},
       {.name = "affine", .method = Method::Chained, .registration = Affine},
       {.name = "chen20", .method = Method::Chained, .registration = Chen20},
       {.name = "ours_chained", .method = Method::Chained, .registration = Ours},
       {.name = "mcl", .registration = {}},
       {.name = "mcl+measure", .registration = Ours, .measure = true},
       {.name = "mcl+propose", .registration = Ours, .propose = true},
       {.name = "ours+smooth",
        .registration = Ours,
        .propose = true,
        .measure = true,
        .smoothing = Smoothing::Whole},
       {.name = "ours+lag",
        .registration = Ours,
        .propose = true,
        .measure = true,
        .smoothing = Smoothing::Lagged},
       {.name = "ours", .registration = Ours, .propose = true, .measure = true}}};
  return kMethods;
}

const LocalizationMethod& localization_method(const std::string& name) {
  const std::span<const LocalizationMethod> all = localization_methods();
  const auto found = std::ranges::find(all, name, &LocalizationMethod::name);
  if (found == all.end()) {
    std::string names;
    for (const LocalizationMethod& method : all) {
      names += (names.empty() ? "" : ", ") + method.name;
    }
    throw std::invalid_argument("there is no method " + name + "; there are " + names);
  }
  return *found;
}

LocalizerParams params_of(const LocalizationMethod& method, const LocalizerParams& params) {
  LocalizerParams of_method = params;
  of_method.fusion.propose = params.fusion.propose && method.propose;
  of_method.fusion.measure = params.fusion.measure && method.measure;
  return of_method;
}

}  // namespace sketchloc
