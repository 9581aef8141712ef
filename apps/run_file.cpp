#include "apps/run_file.hpp"

#include <yaml-cpp/yaml.h>

#include <stdexcept>

#include "apps/config.hpp"
#include "apps/version.hpp"

namespace sketchloc {
namespace {

/// Options that were given several times as lists.
std::string inputs_text(const RunDescription& run) {
  YAML::Node inputs;
  for (const auto& [option, value] : run.inputs) {
    YAML::Node there = inputs[option];
    if (!there.IsDefined()) {
      there = value;
    } else if (there.IsSequence()) {
      there.push_back(value);
    } else {
      const auto first = there.as<std::string>();
      there = YAML::Node(YAML::NodeType::Sequence);
      there.push_back(first);
      there.push_back(value);
    }
  }
  YAML::Emitter out;
  out << YAML::BeginMap << YAML::Key << "inputs" << YAML::Value << inputs << YAML::EndMap;
  return std::string(out.c_str()) + "\n";
}

RunDescription description_in(const YAML::Node& yaml) {
  RunDescription run{.command = yaml["sketchloc"]["command"].as<std::string>(),
                     .seed = {},
                     .inputs = {},
                     .parameters = {}};
  if (const YAML::Node drawing = yaml["drawing"]) {
    run.drawing = PictureSize{.width_px = drawing["width_px"].as<int>(),
                              .height_px = drawing["height_px"].as<int>()};
  }
  if (yaml["seed"]) {
    run.inputs.emplace_back("seed", yaml["seed"].as<std::string>());
  }
  for (const auto& entry : yaml["inputs"]) {
    const auto option = entry.first.as<std::string>();
    if (!entry.second.IsSequence()) {
      run.inputs.emplace_back(option, entry.second.as<std::string>());
      continue;
    }
    for (const YAML::Node& value : entry.second) {
      run.inputs.emplace_back(option, value.as<std::string>());
    }
  }
  return run;
}

}  // namespace

std::string run_file_text(const RunDescription& run) {
  ConfigNode head;
  ConfigNode& program = head.child("sketchloc");
  program.child("version").text = version();
  program.child("commit").text = commit();
  program.child("command").text = run.command;
  if (run.drawing) {
    ConfigNode& drawing = head.child("drawing");
    drawing.child("width_px") = to_config(run.drawing->width_px);
    drawing.child("height_px") = to_config(run.drawing->height_px);
  }
  if (run.seed) {
    head.child("seed") = to_config(*run.seed);
  }
  ConfigNode tail;
  tail.child("parameters") = run.parameters;
  return to_yaml(head) + (run.inputs.empty() ? "" : inputs_text(run)) + to_yaml(tail);
}

std::optional<RunDescription> read_run_description(const std::filesystem::path& file) {
  try {
    const YAML::Node yaml = YAML::LoadFile(file.string());
    const bool of_a_run = yaml.IsMap() && yaml["sketchloc"] && yaml["sketchloc"].IsMap() &&
                          yaml["sketchloc"]["command"];
    return of_a_run ? std::optional(description_in(yaml)) : std::nullopt;
  } catch (const YAML::BadFile&) {
    return std::nullopt;  // whoever reads the parameters says so
  } catch (const YAML::Exception& error) {
    throw std::invalid_argument(file.string() + ":" + std::to_string(error.mark.line + 1) + ": " +
                                error.msg);
  }
}

}  // namespace sketchloc
