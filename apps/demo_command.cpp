#include "apps/demo_command.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "apps/localize_command.hpp"
#include "apps/program.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

/// Where `name` of the samples is: beside the installed program, else where it was built from.
fs::path sample(const fs::path& name) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  for (const fs::path& folder :
       {program.parent_path() / SKETCHLOC_INSTALLED_SAMPLES, fs::path(SKETCHLOC_SAMPLES)}) {
    if (fs::exists(folder / name)) {
      return (folder / name).lexically_normal();
    }
  }
  throw std::runtime_error("the sample " + name.string() + " is neither installed beside " +
                           program.string() + " nor in " SKETCHLOC_SAMPLES);
}

struct DemoOptions {
  fs::path out = "sketchloc-demo";
};

void run_demo(const DemoOptions& options) {
  LocalizeOptions localize;
  localize.map = sample("office/drawing.png");
  localize.log = sample("office/log.jsonl.gz");
  localize.reference = sample("office/reference.csv");
  localize.start.from_reference = true;
  localize.out = options.out;
  localize.force = true;  // of its own earlier result; a foreign folder is refused all the same
  localize.title = "A simulated robot in a simulated person's drawing of an office";
  run_localize(localize);
}

}  // namespace

void add_demo_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "demo", "Localize the robot of the sample that comes with the program.");
  auto options = std::make_shared<DemoOptions>();
  command->add_option("--out", options->out, "Folder of the results; an earlier one is replaced")
      ->group(kOutputGroup)
      ->type_name("DIR")
      ->capture_default_str();
  command->callback([options] { run_demo(*options); });
}

}  // namespace sketchloc
