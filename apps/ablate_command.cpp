#include "apps/ablate_command.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/ablate_suites.hpp"
#include "apps/option_checks.hpp"
#include "apps/program.hpp"

namespace sketchloc {

void add_ablate_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "ablate", "Compare methods on the same questions: tables with intervals, and a page.");
  const auto options = std::make_shared<AblateOptions>();
  const auto option = [&](const std::string& flag, auto& value, const std::string& help) {
    return command->add_option(flag, value, help)->group(kAlgorithmGroup);
  };
  option("--suite", options->suite,
         "registration: one submap, one prior, one pose; filter: whole simulated runs; robust: the "
         "same with what may go wrong; real: the runs of --set alone; topology: labelled runs of "
         "--set TRAJECTORY.tum,LABELS.csv,REFERENCE.tum[,NAME]; planning: ways in simulated "
         "drawings; navigation: drives to goals in them")
      ->check(CLI::IsMember(
          {"registration", "filter", "robust", "real", "topology", "planning", "navigation"}))
      ->capture_default_str();
  option("--methods", options->methods,
         "Rows (default all). registration: ours, chen20, affine, icp, none (keep the prior); the "
         "first is shown in pictures. Others: odometry; icp, affine, chen20, ours_chained (one "
         "registration after the other); mcl, mcl+measure, mcl+propose, ours, ours+lag, "
         "ours+smooth")
      ->delimiter(',');
  option("--network", options->networks, "Another network for a method")
      ->type_name("METHOD=FILE.onnx");
  option("--set", options->sets,
         "A recorded run to ask about as well; may be repeated; NAME as KIND/NAME puts runs of one "
         "kind into one row; ALTERNATIVE: another reading of the drawing that counts too")
      ->type_name("DRAWING,LOG,REFERENCE.csv[,NAME[,ALTERNATIVE.csv]]");
  option("--seed", options->seed, "Of buildings, drawings, drives and priors")
      ->check(whole_number())
      ->capture_default_str();
  option("--seeds", options->seeds, "Not for registration: runs of the filter on each set")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_parameter_options(*command, suite_config({}), options->parameters);
  command->add_option("--out", options->out, "Folder of the results")
      ->required()
      ->group(kOutputGroup)
      ->type_name("DIR");
  command->add_flag("--force", options->force, "Replace an earlier result")->group(kOutputGroup);
  add_jobs_option(*command, options->jobs);
  command->callback([options] {
    if (options->suite == "registration") {
      run_registration_suite(*options);
    } else if (options->suite == "topology") {
      run_topology_suite(*options);
    } else if (options->suite == "planning") {
      run_planning_suite(*options);
    } else if (options->suite == "navigation") {
      run_navigation_suite(*options);
    } else {
      run_filter_suite(*options);
    }
  });
}

}  // namespace sketchloc
