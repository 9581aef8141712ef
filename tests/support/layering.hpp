#pragma once

#include <compare>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace sketchloc::testing {

/// One folder of the floor plan, in the words of the table in docs/architecture.md.
struct FloorPlanRow {
  std::string folder;
  std::string may_include;
  std::string libraries;
  auto operator<=>(const FloorPlanRow&) const = default;
};
std::vector<FloorPlanRow> floor_plan_rows();

/// An #include that breaks the floor plan of docs/architecture.md.
struct LayeringViolation {
  std::string file;  ///< from the project's root
  int line = 0;
  std::string what;  ///< the include and the rule that it breaks
};

/// The violations in one source text that stands at `file` (a path from the root); quoted
/// includes must be found in `root`.
std::vector<LayeringViolation> layering_violations(std::string_view source, const std::string& file,
                                                   const std::filesystem::path& root);

/// The same for every *.hpp and *.cpp of the project's folders.
std::vector<LayeringViolation> layering_violations(const std::filesystem::path& root);

}  // namespace sketchloc::testing
