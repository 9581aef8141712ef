#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "apps/parameter_options.hpp"
#include "eval/navigation.hpp"

namespace CLI {
class App;
}

namespace sketchloc {

struct NavigateParams {
  NavigationParams navigation;
  LocalizationParams filter;
};

template <typename Visitor>
void visit_fields(NavigateParams& params, Visitor&& visit) {
  visit("navigation", params.navigation);
  visit("filter", params.filter);
}

/// What `sketchloc navigate` is told.
struct NavigateOptions {
  int plan = 1;  ///< by turns home, office, warehouse
  std::string person = "human";
  std::string method = "ours";
  std::uint64_t seed = 1;
  ParameterOptions parameters;

  std::filesystem::path out;
  bool force = false;
};

/// Throws std::invalid_argument for options that make no sense.
void run_navigate(const NavigateOptions& options);

void add_navigate_command(CLI::App& program);

}  // namespace sketchloc
