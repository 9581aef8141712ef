#include "datasets/io/run_io.hpp"
#include "tests/datasets/io/files.hpp"

namespace sketchloc {
namespace {

using ::testing::AllOf;
using testing::content_of;
using ::testing::ElementsAre;
using testing::FailsWith;
using ::testing::HasSubstr;

constexpr const char* kScan = "FLASER 1 1.5 0 0 0 0 0 0 7.5 robot 7.5\n";

class DamagedLog : public testing::FileTest {
 protected:
  static std::string scans(int count) {
    std::string log;
    for (int i = 0; i < count; ++i) {
      log += kScan;
    }
    return log;
  }
  std::filesystem::path cut(const std::filesystem::path& whole, std::size_t bytes_left) const {
    return file("cut.log", content_of(whole).substr(0, bytes_left));
  }
};

TEST_F(DamagedLog, IsFoundByContentWhateverItsName) {
  EXPECT_EQ(read_run(file("a.txt", kScan)).steps.size(), 1U);
  EXPECT_EQ(read_run(gzip_file("b.txt", kScan)).steps.size(), 1U);
  EXPECT_THAT([&] { read_run(file("c.bag", "#ROSBAG V2.0\n...")); },
              FailsWith("expected a CARMEN log or JSON lines, plain or gzip, found a ROS 1 bag"));
}

TEST_F(DamagedLog, SaysThatAFileIsMissingOrAFolder) {
  EXPECT_THAT([&] { read_run(missing("no.log")); },
              FailsWith("no.log: cannot be opened: No such file"));
  EXPECT_THAT([&] { read_run(folder()); }, FailsWith("Is a directory"));
}

TEST_F(DamagedLog, SaysThatItIsEmptyAndThatNanIsNoJson) {
  EXPECT_THAT([&] { read_run(file("run.log", "")); }, FailsWith("run.log: is empty"));
  EXPECT_THAT([&] { read_run(file("run.jsonl", "{\"time_s\": NaN}\n")); },
              FailsWith("run.jsonl:1: JSON: NaN is no JSON; use null"));
}

TEST_F(DamagedLog, ThatEndsInALineSaysHowToKeepTheRest) {
  const std::filesystem::path log = file("run.log", scans(2) + "FLASER 1 1.5 0 0");
  EXPECT_THAT([&] { read_run(log); },
              FailsWith(AllOf(HasSubstr("run.log:3: the log ends in the middle of this line"),
                              HasSubstr("--allow-truncated"))));
  const RunFile rest = read_run_file(log, {.allow_truncated = true});
  EXPECT_EQ(rest.run.steps.size(), 2U);
  EXPECT_THAT(rest.notes, ElementsAre(HasSubstr("dropped the torn end of the log at line 3")));
}

TEST_F(DamagedLog, MayLackTheLastEndOfLine) {
  const std::string log = scans(2);
  EXPECT_EQ(read_run(file("run.log", log.substr(0, log.size() - 1))).steps.size(), 2U);
}

TEST_F(DamagedLog, WithAWrongLineInsideIsAnErrorEvenIfTruncationIsAllowed) {
  const std::filesystem::path log = file("run.log", "FLASER 1 1.5 0 0\n" + scans(2));
  EXPECT_THAT([&] { read_run(log, {.allow_truncated = true}); }, FailsWith("run.log:1: theta"));
}

TEST_F(DamagedLog, CutInsideItsGzipStreamSaysHowToKeepTheRest) {
  const std::filesystem::path whole = gzip_file("run.log.gz", scans(5000));
  const std::filesystem::path log = cut(whole, content_of(whole).size() / 2);
  EXPECT_THAT([&] { read_run(log); }, FailsWith("the gzip stream ends"));
  const RunFile rest = read_run_file(log, {.allow_truncated = true});
  EXPECT_GT(rest.run.steps.size(), 1000U);
  EXPECT_LT(rest.run.steps.size(), 4000U);
  EXPECT_EQ(rest.notes.size(), 1U);
}

TEST_F(DamagedLog, CutAnywhereInItsGzipStreamNeverPassesForWhole) {
  const std::filesystem::path whole = gzip_file("run.log.gz", scans(20));
  const std::size_t bytes = content_of(whole).size();
  for (std::size_t left = 2; left < bytes; ++left) {
    EXPECT_THROW(read_run(cut(whole, left)), std::runtime_error) << left << " of " << bytes;
  }
}

TEST_F(DamagedLog, WithFlippedBitsInItsGzipStreamIsAnError) {
  std::string bytes = content_of(gzip_file("run.log.gz", scans(5000)));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x10);
  const std::filesystem::path log = file("flipped.log", bytes);
  EXPECT_THROW(read_run(log, {.allow_truncated = true}), std::runtime_error);
}

TEST_F(DamagedLog, WithAnEndlessLineIsRefusedInBoundedMemory) {
  const std::filesystem::path log = file("run.log", "FLASER " + std::string(100'000'000, '1'));
  EXPECT_THAT([&] { read_run(log); }, FailsWith("run.log:1: line: expected at most 4194304 bytes"));
}

TEST_F(DamagedLog, ThatIsAGzipBombIsRefusedInBoundedMemory) {
  const std::filesystem::path zeros = gzip_file("zeros.gz", std::string(50'000'000, '\0'));
  EXPECT_THAT([&] { read_run(zeros); }, FailsWith("line: expected at most 4194304 bytes"));
  const std::filesystem::path lines = gzip_file("lines.gz", std::string(50'000'000, '\n'));
  EXPECT_THAT([&] { read_run(lines, {.max_total_bytes = 10'000'000}); },
              FailsWith("text: expected at most 10000000 bytes after unpacking"));
}

TEST_F(DamagedLog, ReadingsAreChecked) {
  EXPECT_THROW(read_run(file("run.log", kScan), {.max_range_m = 0.0}), std::invalid_argument);
  EXPECT_THROW(read_run(file("run.log", kScan), {.max_line_bytes = 0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
