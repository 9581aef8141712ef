#pragma once

namespace CLI {
class App;
}

namespace sketchloc {

/// `sketchloc evaluate`: a metric trajectory, or a run in a drawing, against a reference.
void add_evaluate_command(CLI::App& program);

}  // namespace sketchloc
