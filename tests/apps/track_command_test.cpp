#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "datasets/io/reference_io.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_writer.hpp"
#include "datasets/sim/data_set.hpp"
#include "tests/support/run_command.hpp"
#include "tests/support/running_program.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::CommandResult;
using testing::content_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::RunningProgram;
using testing::TemporaryDirectory;

std::vector<json> parsed(const std::string& lines) {
  std::vector<json> found;
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);) {
    found.push_back(json::parse(line));
  }
  return found;
}

/// Of the scans that were tracked: x, y, heading.
std::vector<std::vector<double>> poses_in(const std::string& lines) {
  std::vector<std::vector<double>> poses;
  for (const json& line : parsed(lines)) {
    if (line.contains("pose")) {
      const json& pose = line["pose"];
      poses.push_back({pose["x_px"], pose["y_px"], pose["heading_rad"], pose["scale_px_per_m"]});
    }
  }
  return poses;
}

json summary_in(const std::string& lines) { return parsed(lines).back().at("summary"); }

/// A small simulated home as a data set, made once for all tests.
class TrackCommandEndToEnd : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    inputs_ = new TemporaryDirectory();
    DataSetParams params;
    params.building = BuildingKind::Home;
    params.drive.length_m = 8.0;
    data_set_ = new DataSet(generate_data_set(params, 3));
    write_sketch(*inputs_ / "drawing.png", data_set_->drawing.sketch);
    write_jsonl(*inputs_ / "log.jsonl", data_set_->run);
    write_reference(*inputs_ / "reference.csv", data_set_->reference,
                    data_set_->drawing.sketch.height_px());
  }
  static void TearDownTestSuite() {
    delete inputs_;
    delete data_set_;
  }

  static std::vector<std::string> small() {
    return {"--localizer.particles.min_particles", "1000",
            "--localizer.particles.max_particles", "2000",
            "--localizer.table.memory_mb",         "20"};
  }
  /// From the reference's first pose, with no deadline unless `more` has one.
  static std::vector<std::string> command(const std::vector<std::string>& more) {
    std::vector<std::string> words = {SKETCHLOC_PROGRAM, "track", inputs_->path().string()};
    const std::vector<std::string> particles = small();
    words.insert(words.end(), particles.begin(), particles.end());
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
  static std::vector<std::string> from_reference(std::vector<std::string> more) {
    more.insert(more.end(), {"--start-from-reference", "--deadline-ms", "0"});
    return command(more);
  }
  static std::string log() { return (*inputs_ / "log.jsonl").string(); }
  /// Lines [begin, end) of the log.
  static std::string log_lines(std::size_t begin, std::size_t end) {
    std::string text;
    for (std::size_t i = begin; i < std::min(end, data_set_->run.steps.size()); ++i) {
      text += json_line(data_set_->run.steps[i]) + "\n";
    }
    return text;
  }
  static double error_m(const json& line, std::size_t step) {
    const Sim2& truth = data_set_->reference.poses[step].sketch_from_robot;
    const double x = line["pose"]["x_px"];
    const double y = line["pose"]["y_px"];
    return std::hypot(x - truth.x(), y - truth.y()) / truth.scale();
  }
  static std::string replayed() {
    static const std::string out =
        testing::run_command(from_reference({"--replay", log(), "--rate", "0"})).out;
    return out;
  }

  static TemporaryDirectory* inputs_;
  static DataSet* data_set_;
  TemporaryDirectory outputs_;
};

TemporaryDirectory* TrackCommandEndToEnd::inputs_ = nullptr;
DataSet* TrackCommandEndToEnd::data_set_ = nullptr;

TEST_F(TrackCommandEndToEnd, GivesASmoothedPoseOfEachScanALagLater) {
  const CommandResult result = testing::run_command(
      from_reference({"--replay", log(), "--rate", "0", "--lag", "--smoothing.lag.lag_m", "2"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  std::size_t tracked = 0;
  std::size_t smoothed = 0;
  for (const json& line : parsed(result.out)) {
    if (line.value("status", "") == "tracked") {
      EXPECT_EQ(line["step"], tracked++);
    } else if (line.value("status", "") == "smoothed") {
      EXPECT_EQ(line["step"], smoothed);
      EXPECT_LT(error_m(line, smoothed), 1.0) << line;
      EXPECT_TRUE(line["lag_m"] >= 2.0 || tracked == data_set_->run.steps.size()) << line;
      ++smoothed;
    }
    EXPECT_LE(smoothed, tracked);
  }
  EXPECT_EQ(tracked, data_set_->run.steps.size());
  EXPECT_EQ(smoothed, tracked);
}

TEST_F(TrackCommandEndToEnd, SmoothsOnlyWithRegistrations) {
  const CommandResult result =
      testing::run_command(from_reference({"--replay", log(), "--lag", "--method", "mcl"}));
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--lag needs a filter with registrations"));
}

TEST_F(TrackCommandEndToEnd, GivesThePosesOfLocalize) {
  std::vector<std::string> localize = {SKETCHLOC_PROGRAM,
                                       "localize",
                                       "--map",
                                       (*inputs_ / "drawing.png").string(),
                                       "--log",
                                       log(),
                                       "--reference",
                                       (*inputs_ / "reference.csv").string(),
                                       "--start-from-reference",
                                       "--out",
                                       (outputs_ / "result").string()};
  const std::vector<std::string> particles = small();
  localize.insert(localize.end(), particles.begin(), particles.end());
  ASSERT_EQ(testing::run_command(localize).exit_code, 0);
  std::ifstream csv(outputs_ / "result/trajectory.csv");
  std::string line;
  std::getline(csv, line);
  ASSERT_TRUE(line.starts_with("step,time_s,x_px,y_px,heading_rad,scale_px_per_m")) << line;
  std::vector<std::vector<double>> poses;
  while (std::getline(csv, line)) {
    std::istringstream cells(line);
    std::vector<double> numbers;
    for (std::string cell; std::getline(cells, cell, ',') && numbers.size() < 6;) {
      numbers.push_back(std::stod(cell));
    }
    poses.emplace_back(numbers.begin() + 2, numbers.end());
  }
  EXPECT_EQ(poses_in(replayed()), poses);
}

TEST_F(TrackCommandEndToEnd, GivesTheSamePosesThroughAPipe) {
  RunningProgram track(from_reference({}));
  track.write(content_of(log()));
  const CommandResult result = track.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(poses_in(result.out), poses_in(replayed()));
  const json summary = summary_in(result.out);
  EXPECT_EQ(summary["end"], "end of input");
  EXPECT_EQ(summary["scans"]["tracked"], data_set_->run.steps.size());
  EXPECT_EQ(summary["input"]["malformed"], 0);
}

int port_in(const std::string& err) {
  const std::string before = "listens on 127.0.0.1:";
  const std::size_t at = err.find(before);
  return at == std::string::npos ? 0 : std::stoi(err.substr(at + before.size()));
}

TEST_F(TrackCommandEndToEnd, GivesTheSamePosesThroughTcpToOneClientAfterTheOther) {
  RunningProgram track(from_reference({"--listen", "0"}));
  ASSERT_TRUE(RunningProgram::wait_until([&] { return port_in(track.err()) > 0; })) << track.err();
  const int port = port_in(track.err());
  const std::size_t half = data_set_->run.steps.size() / 2;
  const std::string first = testing::exchange_by_tcp(port, log_lines(0, half));
  const std::string second = testing::exchange_by_tcp(port, "nonsense\n" + log_lines(half, 9999));
  EXPECT_EQ(parsed(first).size(), half);
  EXPECT_EQ(poses_in(first + second), poses_in(replayed()));
  track.send_signal(SIGTERM);
  const CommandResult result = track.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(poses_in(result.out), poses_in(replayed()));
  EXPECT_EQ(summary_in(result.out)["end"], "interrupted");
  EXPECT_EQ(summary_in(result.out)["input"]["malformed"], 1);
}

TEST_F(TrackCommandEndToEnd, JoinsScansWithOdometryThatComesApart) {
  std::string lines;
  for (const RunStep& step : data_set_->run.steps) {
    json whole = json::parse(json_line(step));
    lines += json{{"time_s", whole["time_s"]}, {"odometry", whole["odometry"]}}.dump() + "\n";
    lines += json{{"time_s", whole["time_s"]}, {"scan", whole["scan"]}}.dump() + "\n";
  }
  RunningProgram track(from_reference({}));
  track.write(lines);
  const CommandResult result = track.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(poses_in(result.out), poses_in(replayed()));
}

TEST_F(TrackCommandEndToEnd, SurvivesWhatRobotsSend) {
  std::string lines = "\n{}\n[1,2\n{\"time_s\": 1}\n\xff\xfe\n" + std::string(5 << 20, 'x') + "\n";
  for (std::size_t i = 0; i < data_set_->run.steps.size(); ++i) {
    json step = json::parse(json_line(data_set_->run.steps[i]));
    json& ranges = step["scan"]["ranges_m"];
    if (i % 10 == 3) {
      ranges.erase(ranges.begin() + 5, ranges.end());  // a changing number of beams
    } else if (i % 10 == 5) {
      lines += step.dump() + "\n";  // twice
    } else if (i % 10 == 7) {
      std::string text = step.dump();
      text.replace(text.find("ranges_m\":[") + 11, 0, "NaN,");
      lines += text + "\n";
      continue;
    } else if (i % 10 == 9) {
      step["time_s"] = step["time_s"].get<double>() - 1e6;  // one message of another clock
    }
    lines += step.dump() + "\n";
  }
  lines += "{\"time_s\": 3, \"odo";  // torn
  RunningProgram track(from_reference({}));
  track.write(lines);
  const CommandResult result = track.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const json summary = summary_in(result.out);
  EXPECT_EQ(summary["input"]["malformed"], 6);
  EXPECT_GT(summary["input"]["with_nan"], 0);
  EXPECT_GT(summary["input"]["beam_count_changes"], 0);
  EXPECT_GT(summary["scans"]["duplicate"], 0);
  EXPECT_GT(summary["scans"]["out_of_order"], 0);
  EXPECT_THAT(result.err, HasSubstr("stdin:2: no \"time_s\""));
  std::vector<json> all = parsed(result.out);
  all.pop_back();
  while (all.back()["status"] != "tracked") {
    all.pop_back();
  }
  EXPECT_LT(error_m(all.back(), data_set_->run.steps.size() - 1), 2.0);
}

TEST_F(TrackCommandEndToEnd, GoesOnAfterBeingKilled) {
  const std::string state = (outputs_ / "robot.state").string();
  const std::string out = (outputs_ / "poses.jsonl").string();
  const std::vector<std::string> options = {"--state", state, "--state-every-s", "0.001",
                                            "--out",   out,   "--resume"};
  const std::size_t half = data_set_->run.steps.size() / 2;
  {
    RunningProgram track(from_reference(options));
    track.write(log_lines(0, half));
    ASSERT_TRUE(RunningProgram::wait_until([&] {
      return poses_in(content_of(out)).size() == half && fs::exists(state);
    })) << track.err();
    track.send_signal(SIGKILL);
    EXPECT_EQ(track.wait().exit_code, -1);
  }
  const std::size_t begin = half + 5;
  std::vector<std::string> elsewhere = command(options);  // no start is needed
  elsewhere.insert(elsewhere.end(), {"--deadline-ms", "0"});
  RunningProgram track(elsewhere);
  track.write(log_lines(begin, 9999));
  const CommandResult result = track.wait();
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("goes on from"));
  std::vector<json> all = parsed(content_of(out));
  all.pop_back();
  ASSERT_EQ(all.size(), half + data_set_->run.steps.size() - begin);
  for (std::size_t i = half; i < all.size(); ++i) {
    EXPECT_LT(error_m(all[i], begin + i - half), 1.5);
  }
}

TEST_F(TrackCommandEndToEnd, RefusesTheStateOfSomethingElse) {
  const std::string state = (outputs_ / "robot.state").string();
  ASSERT_EQ(
      testing::run_command(from_reference({"--replay", log(), "--rate", "0", "--state", state}))
          .exit_code,
      0);
  const auto refused = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = from_reference({"--replay", log(), "--state", state});
    words.insert(words.end(), more.begin(), more.end());
    const CommandResult result = testing::run_command(words);
    EXPECT_NE(result.exit_code, 0);
    EXPECT_EQ(result.out, "");
    return result.err;
  };
  EXPECT_THAT(refused({}), HasSubstr("give --resume"));
  EXPECT_THAT(refused({"--resume", "--seed", "2"}),
              HasSubstr("it was kept with `seed: 1`, now there is `seed: 2`"));
  EXPECT_THAT(refused({"--resume", "--localizer.gate.way_m", "0.2"}), HasSubstr("way_m: 0.2"));
  EXPECT_THAT(refused({"--resume", "--odometry", "raw"}), HasSubstr("odometry"));
  std::ofstream(state, std::ios::app) << "x";
  EXPECT_THAT(refused({"--resume"}), HasSubstr("is damaged"));
  std::ofstream(state) << "hello";
  EXPECT_THAT(refused({"--resume"}), HasSubstr("is no state"));
}

TEST_F(TrackCommandEndToEnd, EndsCleanlyOnASignal) {
  for (const int signal : {SIGINT, SIGTERM}) {
    RunningProgram track(from_reference({}));
    track.write(log_lines(0, 3));
    ASSERT_TRUE(RunningProgram::wait_until([&] { return poses_in(track.out()).size() == 3; }));
    track.send_signal(signal);
    ASSERT_TRUE(RunningProgram::wait_until(
        [&] { return track.out().find("\"summary\"") != std::string::npos; }));
    const CommandResult result = track.wait();
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(summary_in(result.out)["end"], "interrupted");
  }
}

TEST_F(TrackCommandEndToEnd, StartsAnywhere) {
  RunningProgram track(command({"--deadline-ms", "0"}));
  track.write(log_lines(0, 2));
  const CommandResult result = track.wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(poses_in(result.out).size(), 2U);
}

TEST_F(TrackCommandEndToEnd, WaitsForAScanThatTellsTheScale) {
  RunStep blind = data_set_->run.steps.front();
  blind.scan.time_s -= 0.1;
  blind.scan.ranges_m.assign(blind.scan.ranges_m.size(), 0.0F);
  const Sim2& start = data_set_->reference.poses.front().sketch_from_robot;
  std::ostringstream text;
  text << start.x() << "," << start.y() << "," << start.yaw_rad() * 57.29578;
  RunningProgram track(command({"--start", text.str(), "--deadline-ms", "0"}));
  track.write(json_line(blind) + "\n" + log_lines(0, 2));
  const std::vector<json> all = parsed(track.wait().out);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0]["status"], "not_started");
  EXPECT_EQ(all[1]["status"], "tracked");
}

TEST_F(TrackCommandEndToEnd, RefusesOptionsThatDoNotFitTogether) {
  const auto refused = [&](const std::vector<std::string>& more) {
    const CommandResult result = testing::run_command(command(more));
    EXPECT_EQ(result.exit_code, 2) << result.err;
    return result.err;
  };
  EXPECT_THAT(refused({"--rate", "2"}), HasSubstr("--rate is of a --replay"));
  EXPECT_THAT(refused({"--resume"}), HasSubstr("--resume needs the --state"));
  EXPECT_THAT(refused({"--listen", "99999"}), HasSubstr("must be a port"));
  EXPECT_THAT(refused({"--listen", "0", "--replay", log()}), HasSubstr("--listen"));
  EXPECT_THAT(refused({"--deadline-ms", "-1"}), HasSubstr("--deadline-ms"));
  EXPECT_THAT(refused({"--method", "icp"}), HasSubstr("mcl+propose or ours"));
  EXPECT_THAT(refused({"--start", "1,2"}), HasSubstr("--start"));
  EXPECT_THAT(refused({"--start", "-5,2,0"}), HasSubstr("outside"));
  EXPECT_THAT(refused({"--out", log()}), HasSubstr("exists"));
}

}  // namespace
}  // namespace sketchloc
