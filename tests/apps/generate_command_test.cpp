#include "apps/generate_command.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "datasets/io/labels_io.hpp"
#include "datasets/io/reference_io.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_io.hpp"
#include "datasets/io/trajectory_io.hpp"
#include "tests/support/matchers.hpp"
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
  EXPECT_TRUE(contents(folder / "two" / "seed_9") == contents(folder / "second"));
}

TEST(GenerateEndToEnd, MakesTheSameAgainFromARunFileAlone) {
  const testing::TemporaryDirectory folder;
  const auto again = [&](const fs::path& config, const fs::path& out) {
    const CommandResult result = testing::run_command(
        {SKETCHLOC_PROGRAM, "generate", "--quiet", "--config", config, "--out", out});
    EXPECT_EQ(result.exit_code, 0) << result.err;
  };
  generate({"--out", folder / "two", "--count", "2", "--seed", "8", "--kind", "home", "--person",
            "tps"});
  again(folder / "two" / "run.yaml", folder / "same");
  EXPECT_TRUE(contents(folder / "two") == contents(folder / "same"));
  again(folder / "two" / "seed_9" / "run.yaml", folder / "second");
  EXPECT_TRUE(contents(folder / "two" / "seed_9") == contents(folder / "second"));
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
  EXPECT_EQ(read_labels(folder / "set" / "labels.csv").size(), run.steps.size());
}

TEST(GenerateEndToEnd, DrawsTheTrueMapWithItsScaleWhereNobodyDraws) {
  const testing::TemporaryDirectory folder;
  ASSERT_EQ(generate({"--out", folder / "set", "--person", "none"}).exit_code, 0);
  const Sketch sketch = read_any_drawing(folder / "set" / "drawing.yaml");
  EXPECT_DOUBLE_EQ(sketch.px_per_m.value(), 20.0);
  const YAML::Node origin = YAML::LoadFile(folder / "set" / "drawing.yaml")["origin"];
  ASSERT_TRUE(origin.IsSequence());
  EXPECT_EQ(origin.as<std::vector<double>>(), std::vector<double>(3, 0.0));
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

/// A hall of 12 m x 8 m as map and, at half the size, as drawing, with the places in both.
void write_hall(const fs::path& folder) {
  const auto write_pgm = [&](const char* name, int width, int height) {
    std::ofstream file(folder / name);
    file << "P2 " << width << " " << height << " 255\n";
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        const bool free = row >= height / 10 && row < height - height / 10 &&
                          column >= width / 10 && column < width - width / 10;
        file << (free ? "255 " : "0 ");
      }
    }
  };
  write_pgm("map.pgm", 240, 160);
  write_pgm("drawing.pgm", 120, 80);
  std::ofstream pairs(folder / "pairs.csv");
  pairs << "match,drawing,row,column\n"
        << "0,sketch,10,14\n0,model,20.5,28.5\n1,sketch,10,104\n1,model,20.5,208.5\n"
        << "2,sketch,68,104\n2,model,136.5,208.5\n3,sketch,68,14\n3,model,136.5,28.5\n";
}

TEST(GenerateEndToEnd, DrivesThroughAMapThatSomebodyDrew) {
  const testing::TemporaryDirectory folder;
  write_hall(folder / "");
  const CommandResult result = generate({"--map", folder / "map.pgm", "--cell-m", "0.05",
                                         "--drawing", folder / "drawing.pgm", "--correspondences",
                                         folder / "pairs.csv", "--out", folder / "set"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Sketch drawing = read_sketch(folder / "set" / "drawing.png");
  EXPECT_EQ(drawing.occupied, read_sketch(folder / "drawing.pgm").occupied);
  const Reference reference = read_reference(folder / "set" / "reference.csv", 80);
  const MetricTrajectory world_from_robot = read_tum(folder / "set" / "truth.tum");
  ASSERT_EQ(reference.poses.size(), world_from_robot.size());
  bool any_scored = false;
  for (std::size_t i = 0; i < reference.poses.size(); ++i) {
    const Se2& truth = world_from_robot[i].pose;  // 10 px of the drawing per metre
    EXPECT_THAT(reference.poses[i].sketch_from_robot,
                testing::IsNear(Sim2::from_xy_yaw_scale(10 * truth.x_m(), 10 * truth.y_m(),
                                                        truth.yaw_rad(), 10),
                                1e-4));
    any_scored = any_scored || reference.poses[i].scored;
  }
  EXPECT_TRUE(any_scored);
  EXPECT_TRUE(fs::exists(folder / "set" / "reference.yaml"));
}

TEST(GenerateEndToEnd, SaysWhenAMapHasNoRoomOrNothingIsDrawn) {
  const testing::TemporaryDirectory folder;
  write_hall(folder / "");
  const CommandResult tiny =
      generate({"--map", folder / "map.pgm", "--cell-m", "0.001", "--out", folder / "set"});
  EXPECT_EQ(tiny.exit_code, 1);
  EXPECT_THAT(tiny.err, HasSubstr("map.pgm: the robot fits nowhere in this map; check --cell-m"));
  const CommandResult lazy =
      generate({"--map", folder / "map.pgm", "--cell-m", "0.05", "--person.pen.left_out_share", "1",
                "--out", folder / "set"});
  EXPECT_EQ(lazy.exit_code, 1);
  EXPECT_THAT(lazy.err, HasSubstr("map.pgm: nothing of this map is drawn; make "
                                  "--person.pen.left_out_share"));
}

TEST(GenerateEndToEnd, RefusesBuildingsBeyondASensibleSize) {
  const testing::TemporaryDirectory folder;
  write_hall(folder / "");
  const CommandResult result =
      generate({"--map", folder / "map.pgm", "--cell-m", "5", "--out", folder / "set"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("more than max_side_m, 400 m; check --cell-m"));
  const CommandResult both = generate(
      {"--map", folder / "map.pgm", "--cell-m", "0.05", "--kind", "home", "--out", folder / "set"});
  EXPECT_EQ(both.exit_code, 2);
  EXPECT_THAT(both.err, HasSubstr("--kind"));
}

TEST(GenerateEndToEnd, NeedsPlacesForAGivenDrawing) {
  const testing::TemporaryDirectory folder;
  write_hall(folder / "");
  const CommandResult no_pairs =
      generate({"--map", folder / "map.pgm", "--cell-m", "0.05", "--drawing",
                folder / "drawing.pgm", "--out", folder / "set"});
  EXPECT_EQ(no_pairs.exit_code, 2);
  EXPECT_THAT(no_pairs.err, HasSubstr("--correspondences"));
  std::ofstream(folder / "one.csv") << "match,drawing,row,column\n0,sketch,9,9\n0,model,18,18\n";
  const CommandResult one_pair = generate({"--map", folder / "map.pgm", "--cell-m", "0.05",
                                           "--drawing", folder / "drawing.pgm", "--correspondences",
                                           folder / "one.csv", "--out", folder / "set"});
  EXPECT_EQ(one_pair.exit_code, 1);
  EXPECT_THAT(one_pair.err, HasSubstr("at least three"));
}

TEST(GenerateEndToEnd, PrintsStatisticsInsteadOfWriting) {
  const CommandResult result = generate({"--statistics", "--count", "3"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, HasSubstr("| 3 drawings | 5 % | median | 95 % |"));
  EXPECT_THAT(result.out, HasSubstr("| residual change over 10 m, m | "));
  EXPECT_THAT(result.out, HasSubstr("| beams within 0.3 | 0."));
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
