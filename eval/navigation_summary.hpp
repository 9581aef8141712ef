#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "eval/navigation.hpp"

namespace sketchloc {

/// How many drives a suite asks for; plans are by turns homes, offices and warehouses.
struct NavigationSuiteParams {
  int plans = 200;    ///< drawn as people draw, >= 0
  int tps_plans = 0;  ///< drawn under one spline, as in [Chen20], >= 0
};

template <typename Visitor>
void visit_fields(NavigationSuiteParams& params, Visitor&& visit) {
  visit("plans", params.plans);
  visit("tps_plans", params.tps_plans);
}

/// Tables of many trials: `metrics.json`, for a document, and a page, which also says how to see
/// each drive that failed again.
std::string navigation_suite_json(std::span<const NavigationTrial> trials, double success_m);
std::string navigation_suite_markdown(std::span<const NavigationTrial> trials, double success_m);
std::string navigation_suite_html(std::span<const NavigationTrial> trials, double success_m,
                                  std::uint64_t seed);

}  // namespace sketchloc
