#include "apps/generate_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "datasets/io/reference_io.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_io.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

using testing::CommandResult;
using ::testing::HasSubstr;

CommandResult generate(std::vector<std::string> arguments) {
  std::vector<std::string> command = {SKETCHLOC_PROGRAM, "generate", "--quiet", "--drive.length_m",
                                      "15"};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return testing::run_command(command);
}

/// The bytes of all files under a folder, by relative path.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file()) {
      std::ifstream file(entry.path(), std::ios::binary);
      files[fs::relative(entry.path(), folder).string()] = {std::istreambuf_iterator(file), {}};
    }
  }
  return files;
}

TEST(GenerateEndToEnd, GivesTheSameBytesForTheSameSeedOnAnyNumberOfThreads) {
  const testing::TemporaryDirectory folder;
  const fs::path one = folder / "one";
  const fs::path four = folder / "four";
  ASSERT_EQ(generate({"--out", one, "--count", "4", "--jobs", "1", "--seed", "3"}).exit_code, 0);
  ASSERT_EQ(generate({"--out", four, "--count", "4", "--jobs", "4", "--seed", "3"}).exit_code, 0);
  EXPECT_EQ(contents(one).size(), 4 * 6 + 1);
  EXPECT_TRUE(contents(one) == contents(four));
}

TEST(GenerateEndToEnd, MakesOneOfSeveralAgainFromItsSeed) {
  const testing::TemporaryDirectory folder;
  generate({"--out", folder / "two", "--count", "2", "--seed", "8", "--kind", "home"});
  generate({"--out", folder / "second", "--seed", "9", "--kind", "home"});
  std::map<std::string, std::string> again = contents(folder / "second");
  again.erase("run.yaml");
  EXPECT_TRUE(contents(folder / "two" / "seed_9") == again);
}

TEST(GenerateEndToEnd, WritesWhatTheReadersRead) {
  const testing::TemporaryDirectory folder;
  ASSERT_EQ(generate({"--out", folder / "set", "--kind", "warehouse"}).exit_code, 0);
  const Sketch sketch = read_sketch(folder / "set" / "drawing.png");
  const sketchloc::Run run = read_run(folder / "set" / "log.jsonl");
  const Reference reference = read_reference(folder / "set" / "reference.csv", sketch.height_px());
  EXPECT_EQ(sketch.kind, Sketch::Kind::Strokes);
  EXPECT_GT(run.steps.size(), 30U);
  EXPECT_EQ(reference.poses.size(), run.steps.size());
}

TEST(GenerateEndToEnd, DrawsTheTrueMapWithItsScaleWhereNobodyDraws) {
  const testing::TemporaryDirectory folder;
  ASSERT_EQ(generate({"--out", folder / "set", "--person", "none"}).exit_code, 0);
  const Sketch sketch = read_any_drawing(folder / "set" / "drawing.yaml");
  EXPECT_DOUBLE_EQ(sketch.px_per_m.value(), 20.0);
}

TEST(GenerateEndToEnd, DrivesThroughAMapOfARealBuilding) {
  const testing::TemporaryDirectory folder;
  generate({"--out", folder / "first", "--person", "none"});  // its map serves as the real one
  const CommandResult result =
      generate({"--out", folder / "second", "--map", folder / "first" / "drawing.yaml"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const CommandResult no_scale =
      generate({"--out", folder / "third", "--map", folder / "first" / "drawing.png"});
  EXPECT_EQ(no_scale.exit_code, 2);
  EXPECT_THAT(no_scale.err, HasSubstr("--cell-m"));
}

TEST(GenerateEndToEnd, PrintsStatisticsInsteadOfWriting) {
  const CommandResult result = generate({"--statistics", "--count", "3"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("| 3 drawings | 5 % | median | 95 % |"));
  EXPECT_THAT(result.out, HasSubstr("| residual change over 10 m, m | "));
}

TEST(GenerateEndToEnd, SaysWhatIsMissingOrOutOfRange) {
  EXPECT_EQ(generate({}).exit_code, 2);
  EXPECT_THAT(generate({}).err, HasSubstr("--out DIR"));
  const CommandResult result = generate({"--out", "x", "--lidar.dropout_share", "2"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("lidar.dropout_share must be in [0, 1]"));
}

}  // namespace
}  // namespace sketchloc
