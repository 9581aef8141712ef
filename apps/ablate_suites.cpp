#include "apps/ablate_suites.hpp"

#include <spdlog/spdlog.h>

#include <set>
#include <stdexcept>

#include "apps/given_network.hpp"
#include "apps/inputs.hpp"
#include "apps/result_files.hpp"
#include "datasets/io/reference_io.hpp"
#include "registration/icp_predictor.hpp"
#include "registration/shipped_networks.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

RecordedSet recorded_set(const std::string& text) {
  const std::vector<std::string> parts = split_text(text, ',');
  if (parts.size() < 3 || parts.size() > 5) {
    throw std::invalid_argument("--set " + text +
                                ": give DRAWING,LOG,REFERENCE.csv[,NAME[,ALTERNATIVE.csv]]");
  }
  const std::string name =
      parts.size() > 3 && !parts[3].empty() ? parts[3] : fs::path(parts[0]).stem().string();
  return {.name = name,
          .kind = name.substr(0, name.find('/')),
          .drawing = parts[0],
          .log = parts[1],
          .reference = parts[2],
          .alternative = parts.size() > 4 ? parts[4] : std::string()};
}

}  // namespace

std::vector<std::string> split_text(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == at) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

ConfigNode suite_config(const AblateParams& params) {
  return without(to_config(params),
                 {"filter.localizer.fusion.propose", "filter.localizer.fusion.measure"});
}

AblateParams suite_parameters(const ParameterOptions& options) {
  const ConfigNode stated = stated_over(suite_config({}), options);
  return from_config<AblateParams>(overlaid(to_config(AblateParams{}), stated));
}

FilterData RecordedSet::read() const {
  FilterData data{
      .sketch = read_drawing_input(drawing, {}), .run = read_log_input(log, {}), .reference = {}};
  data.reference =
      read_reference_input(reference, data.sketch.height_px(), {.run = data.run, .log = log});
  if (!alternative.empty()) {
    data.alternatives.push_back(
        as_reference(read_alternative(alternative, data.sketch.height_px()), data.reference));
  }
  return data;
}

std::vector<RecordedSet> recorded_sets(const AblateOptions& options) {
  std::vector<RecordedSet> sets;
  for (const std::string& text : options.sets) {
    sets.push_back(recorded_set(text));
  }
  return sets;
}

void check_set_names(const std::vector<std::string>& names) {
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (!seen.insert(name).second) {
      throw std::invalid_argument("--set: there are two runs of the name " + name +
                                  "; give DRAWING,LOG,REFERENCE.csv,NAME");
    }
  }
}

fs::path network_given(const AblateOptions& options, const std::string& method) {
  fs::path network;
  for (const std::string& given : options.networks) {
    const std::size_t equals = given.find('=');
    if (equals == given.npos || equals == 0) {
      throw std::invalid_argument("--network " + given + ": give METHOD=FILE.onnx");
    }
    if (!registration_methods().contains(given.substr(0, equals))) {
      throw std::invalid_argument("--network " + given + ": METHOD is ours, chen20 or affine");
    }
    if (given.substr(0, equals) == method) {
      network = given.substr(equals + 1);
    }
  }
  return network;
}

bool can_run(RegistrationMethod method, const std::string& name, const fs::path& network) {
  if (method == RegistrationMethod::Icp && !icp_is_built()) {
    spdlog::warn("{} is left out: this program was built without Open3D", name);
    return false;
  }
  const auto kind = network_of(method);
  if (kind && network.empty() && shipped_network(*kind).empty()) {
    spdlog::warn(
        "{} is left out: no network comes with this program; give --network METHOD=FILE.onnx",
        name);
    return false;
  }
  return true;
}

RunDescription description_of(const AblateOptions& options, const ConfigNode& parameters) {
  RunDescription run{.command = "ablate",
                     .seed = options.seed,
                     .inputs = {{"suite", options.suite}},
                     .parameters = parameters};
  const auto add_all = [&](const char* option, const std::vector<std::string>& values) {
    for (const std::string& value : values) {
      run.inputs.emplace_back(option, value);
    }
  };
  add_all("methods", options.methods);
  add_all("network", options.networks);
  add_all("set", options.sets);
  if (options.suite != "registration") {
    run.inputs.emplace_back("seeds", std::to_string(options.seeds));
  }
  return run;
}

}  // namespace sketchloc
