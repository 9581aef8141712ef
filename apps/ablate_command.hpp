#pragma once

namespace CLI {
class App;
}

namespace sketchloc {

/// `sketchloc ablate`: methods as rows of a table, all on the same questions.
void add_ablate_command(CLI::App& program);

}  // namespace sketchloc
