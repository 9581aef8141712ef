#include "tests/support/layering.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <sstream>

namespace sketchloc::testing {

void PrintTo(const LayeringViolation& violation, std::ostream* out) {
  *out << violation.file << ":" << violation.line << ": " << violation.what;
}

void PrintTo(const FloorPlanRow& row, std::ostream* out) {
  *out << row.folder << " | " << row.may_include << " | " << row.libraries;
}

namespace {

using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAreArray;

const std::filesystem::path kRoot = SKETCHLOC_SOURCE_DIR;

auto violations_of(std::string_view source, const std::string& file) {
  return layering_violations(source, file, kRoot);
}

MATCHER_P2(Breaks, line, rule, "") {
  *result_listener << ::testing::PrintToString(arg);
  return arg.line == line && ::testing::Value(arg.what, HasSubstr(rule));
}

TEST(Layering, HoldsInTheWholeProject) { EXPECT_THAT(layering_violations(kRoot), IsEmpty()); }

std::string trimmed(const std::string& cell) {
  const std::size_t first = cell.find_first_not_of(" `/");
  return first == cell.npos ? "" : cell.substr(first, cell.find_last_not_of(" `/") + 1 - first);
}

/// The rows of the first table whose first column is a folder.
std::vector<FloorPlanRow> documented_rows() {
  std::ifstream document(kRoot / "docs/architecture.md");
  std::vector<FloorPlanRow> rows;
  for (std::string line; std::getline(document, line);) {
    if (!line.starts_with("| `")) {
      continue;
    }
    std::istringstream cells(line.substr(1));
    std::array<std::string, 4> row;
    for (std::string& cell : row) {
      std::getline(cells, cell, '|');
    }
    rows.push_back({trimmed(row[0]), trimmed(row[2]), trimmed(row[3])});
  }
  return rows;
}

TEST(Layering, IsTheTableOfTheArchitecture) {
  EXPECT_THAT(documented_rows(), UnorderedElementsAreArray(floor_plan_rows()));
}

TEST(Layering, LetsArrowsPointDown) {
  EXPECT_THAT(violations_of("#include \"motion/se2.hpp\"\n#include \"datasets/grid.hpp\"\n",
                            "filter/predict.cpp"),
              IsEmpty());
}

TEST(Layering, FindsAnArrowThatPointsUp) {
  EXPECT_THAT(violations_of("// a comment\n#include \"datasets/grid.hpp\"\n", "motion/se2.cpp"),
              ElementsAre(Breaks(2, "motion/ may not include datasets/")));
}

TEST(Layering, FindsNeighboursThatSeeEachOther) {
  EXPECT_THAT(violations_of("#include \"filter/estimate.hpp\"\n", "planning/plan.hpp"),
              ElementsAre(Breaks(1, "planning/ may not include filter/")));
}

TEST(Layering, TellsASubfolderWithItsOwnRowFromItsParent) {
  EXPECT_THAT(violations_of("#include \"datasets/grid.hpp\"\n", "motion/graph/solve.cpp"),
              ElementsAre(Breaks(1, "motion/graph/ may not include datasets/")));
}

TEST(Layering, FindsDetailsUsedFromOutside) {
  const std::string_view source = "#include \"motion/detail/complex_plane.hpp\"\n";
  EXPECT_THAT(violations_of(source, "datasets/scan.cpp"),
              ElementsAre(Breaks(1, "belongs to motion/ alone")));
  EXPECT_THAT(violations_of(source, "motion/se2.cpp"), IsEmpty());
  EXPECT_THAT(violations_of(source, "tests/motion/se2_test.cpp"), IsEmpty());
}

TEST(Layering, FindsAHeavyLibraryInAPublicHeader) {
  const std::string_view source = "#pragma once\n#  include <opencv2/imgproc.hpp>\n";
  EXPECT_THAT(violations_of(source, "eval/raster.hpp"),
              ElementsAre(Breaks(2, "public headers include only")));
  EXPECT_THAT(violations_of(source, "eval/raster.cpp"), IsEmpty());
  EXPECT_THAT(violations_of(source, "eval/detail/raster.hpp"), IsEmpty());
}

TEST(Layering, FindsALibraryInAFolderThatDoesNotUseIt) {
  EXPECT_THAT(violations_of("#include <nlohmann/json.hpp>\n", "filter/localizer.cpp"),
              ElementsAre(Breaks(1, "filter/ does not use json")));
}

TEST(Layering, LetsReadersShowAnImageMatrix) {
  EXPECT_THAT(violations_of("#include <opencv2/core/mat.hpp>\n", "datasets/io/sketch_io.hpp"),
              IsEmpty());
}

TEST(Layering, FindsIncludesThatDoNotStartAtTheRoot) {
  EXPECT_THAT(violations_of("#include \"se2.hpp\"\n", "motion/sim2.hpp"),
              ElementsAre(Breaks(1, "start at the root")));
}

TEST(Layering, FindsAFolderThatIsNotOnTheFloorPlan) {
  EXPECT_THAT(violations_of("", "helpers/helpers.cpp"),
              ElementsAre(Breaks(1, "not on the floor plan")));
}

}  // namespace
}  // namespace sketchloc::testing
