#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/parameter_options.hpp"
#include "apps/run_file.hpp"
#include "datasets/reference.hpp"
#include "datasets/run.hpp"
#include "datasets/sketch.hpp"
#include "eval/filter_suite.hpp"
#include "eval/localization.hpp"
#include "eval/navigation_summary.hpp"
#include "eval/planning_suite.hpp"
#include "eval/predictors.hpp"
#include "eval/registration_suite.hpp"
#include "eval/topology_suite.hpp"

namespace sketchloc {

/// What `sketchloc ablate` is told.
struct AblateOptions {
  std::string suite = "registration";
  std::vector<std::string> methods;  ///< empty: all of the suite
  std::vector<std::string> networks;
  std::vector<std::string> sets;
  std::uint64_t seed = 1;
  int seeds = 5;
  unsigned jobs = 0;
  std::filesystem::path out;
  bool force = false;
  ParameterOptions parameters;
};

struct AblateParams {
  RegistrationSuiteParams registration;
  FilterSuiteParams drives;
  LocalizationParams filter;  ///< its predictor is that of the registration suite too
  TopologyParams topology;
  TopologySuiteParams topology_suite;
  PlanParams planning;
  PlanningSuiteParams planning_suite;
  NavigationParams navigation;
  NavigationSuiteParams navigation_suite;
};

template <typename Visitor>
void visit_fields(AblateParams& params, Visitor&& visit) {
  visit("registration", params.registration);
  visit("drives", params.drives);
  visit("filter", params.filter);
  visit("topology", params.topology);
  visit("topology_suite", params.topology_suite);
  visit("planning", params.planning);
  visit("planning_suite", params.planning_suite);
  visit("navigation", params.navigation);
  visit("navigation_suite", params.navigation_suite);
}

/// What people may set, and what run.yaml records: all but what the rows of the filter suites
/// decide.
ConfigNode suite_config(const AblateParams& params);
AblateParams suite_parameters(const ParameterOptions& options);

/// A recorded run to ask about, read when it is needed. Text: DRAWING,LOG,REFERENCE.csv[,NAME
/// [,ALTERNATIVE.csv]]; NAME as KIND/NAME puts runs of one kind into one row.
struct RecordedSet {
  std::string name;
  std::string kind;
  std::filesystem::path drawing;
  std::filesystem::path log;
  std::filesystem::path reference;
  std::filesystem::path alternative;  ///< empty: none

  FilterData read() const;
};

/// Throws std::invalid_argument where two sets, simulated or recorded, have one name.
void check_set_names(const std::vector<std::string>& names);

/// The sets of --set; throws std::invalid_argument where a text is none.
std::vector<RecordedSet> recorded_sets(const AblateOptions& options);

/// The network given for a registration; empty: none. Throws std::invalid_argument where a
/// --network is no METHOD=FILE of a registration.
std::filesystem::path network_given(const AblateOptions& options, const std::string& method);

/// Whether a registration can run here; else says on stderr why it is left out.
bool can_run(RegistrationMethod method, const std::string& name,
             const std::filesystem::path& network);

/// Everything that was given, for run.yaml.
RunDescription description_of(const AblateOptions& options, const ConfigNode& parameters);

/// The parts of a text between commas or the like.
std::vector<std::string> split_text(const std::string& text, char at);

/// The suites.
void run_navigation_suite(const AblateOptions& options);
void run_planning_suite(const AblateOptions& options);
void run_topology_suite(const AblateOptions& options);
void run_registration_suite(const AblateOptions& options);
void run_filter_suite(const AblateOptions& options);

}  // namespace sketchloc
