#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_io.hpp"
#include "datasets/io/sketch_writer.hpp"
#include "datasets/io/trajectory_io.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

using testing::CommandResult;
using ::testing::HasSubstr;

constexpr const char* kLog =
    "FLASER 3 1 2.5 81.83 9 9 9 0.1 -0.2 0.3 10.5 robot 1.5\n"
    "FLASER 3 1 2.5 81.83 9 9 9 0.2 -0.2 0.3 11.5 robot 1.5\n";

class ConvertEndToEnd : public ::testing::Test {
 protected:
  CommandResult convert(const std::string& input, const std::string& output,
                        const std::vector<std::string>& flags = {}) const {
    std::vector<std::string> command = {SKETCHLOC_PROGRAM, "convert", folder_ / input,
                                        folder_ / output};
    command.insert(command.end(), flags.begin(), flags.end());
    return testing::run_command(command);
  }
  void write(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name) << content;
  }

  testing::TemporaryDirectory folder_;
};

TEST_F(ConvertEndToEnd, TurnsACarmenLogIntoJsonLinesAndItsOdometryIntoTum) {
  write("run.log", kLog);
  const CommandResult result = convert("run.log", "run.jsonl");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("2 scans in"));
  EXPECT_EQ(read_run(folder_ / "run.jsonl").steps.size(), 2U);
  EXPECT_EQ(convert("run.jsonl", "odometry.tum").exit_code, 0);
  EXPECT_EQ(read_tum(folder_ / "odometry.tum")[1].pose.x_m(), 0.2);
}

TEST_F(ConvertEndToEnd, ShowsWhatIsReadAsObstaclesInADrawing) {
  Sketch room{.occupied = Grid<std::uint8_t>(80, 60), .px_per_m = std::nullopt};
  for (int column = 10; column < 70; ++column) {
    room.occupied.at({column, 20}) = 1;
  }
  write_sketch(folder_ / "drawing.png", room);
  const CommandResult result = convert("drawing.png", "obstacles.png");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("strokes, 80 x 60 px"));
  EXPECT_EQ(read_sketch(folder_ / "obstacles.png").occupied, room.occupied);
}

TEST_F(ConvertEndToEnd, ReadsADrawingAsItIsTold) {
  Sketch room{.occupied = Grid<std::uint8_t>(80, 60), .px_per_m = std::nullopt};
  room.occupied.at({40, 20}) = 1;
  write_sketch(folder_ / "drawing.png", room);
  const CommandResult result = convert("drawing.png", "free.png", {"--drawn", "filled-free-space"});
  EXPECT_THAT(result.out, HasSubstr("filled-free-space, 80 x 60 px"));
  EXPECT_EQ(convert("drawing.png", "other.png", {"--polarity", "upside-down"}).exit_code, 2);
}

TEST_F(ConvertEndToEnd, KeepsTheWholeLinesOfATornLogIfAsked) {
  write("run.log", std::string(kLog) + "FLASER 3 1");
  const CommandResult refused = convert("run.log", "run.jsonl");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_THAT(refused.err, HasSubstr("run.log:3: the log ends in the middle of this line"));
  const CommandResult kept = convert("run.log", "run.jsonl", {"--allow-truncated"});
  EXPECT_EQ(kept.exit_code, 0);
  EXPECT_THAT(kept.err, HasSubstr("dropped the torn end"));
  EXPECT_EQ(read_run(folder_ / "run.jsonl").steps.size(), 2U);
}

TEST_F(ConvertEndToEnd, PacksALogWhoseNameEndsInGz) {
  write("run.log", kLog);
  EXPECT_EQ(convert("run.log", "run.jsonl").exit_code, 0);
  EXPECT_EQ(convert("run.log", "run.jsonl.gz").exit_code, 0);
  EXPECT_LT(std::filesystem::file_size(folder_ / "run.jsonl.gz"),
            std::filesystem::file_size(folder_ / "run.jsonl"));
  EXPECT_EQ(read_run(folder_ / "run.jsonl.gz").steps.size(), 2U);
}

TEST_F(ConvertEndToEnd, NeverReplacesItsInput) {
  write("run.jsonl", "mine");
  const CommandResult result = convert("run.jsonl", "run.jsonl", {"--force"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("is the input itself"));
}

TEST_F(ConvertEndToEnd, NeverOverwritesWithoutForce) {
  write("run.log", kLog);
  write("run.jsonl", "mine");
  EXPECT_EQ(convert("run.log", "run.jsonl").exit_code, 2);
  EXPECT_EQ(convert("run.log", "run.jsonl", {"--force"}).exit_code, 0);
}

TEST_F(ConvertEndToEnd, SaysWhichNamesItKnows) {
  write("run.log", kLog);
  const CommandResult result = convert("run.log", "run.bag");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err,
              HasSubstr("must end in .jsonl or .jsonl.gz (log), .tum (its odometry) or .png"));
}

}  // namespace
}  // namespace sketchloc
