#include "apps/run_file.hpp"

#include "apps/config.hpp"
#include "apps/version.hpp"

namespace sketchloc {

std::string run_file_text(const RunDescription& run) {
  ConfigNode file;
  ConfigNode& program = file.child("sketchloc");
  program.child("version").text = version();
  program.child("commit").text = commit();
  program.child("command").text = run.command;
  file.child("seed") = to_config(run.seed);
  for (const auto& [flag, value] : run.inputs) {
    file.child("inputs").child(flag).text = value;
  }
  file.child("parameters") = run.parameters;
  return to_yaml(file);
}

}  // namespace sketchloc
