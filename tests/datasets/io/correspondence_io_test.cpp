#include "datasets/io/correspondence_io.hpp"

#include "tests/datasets/io/files.hpp"

namespace sketchloc {
namespace {

using testing::FailsWith;

constexpr const char* kHeader = "match,drawing,row,column\n";
constexpr PictureSize kSketch = {.width_px = 200, .height_px = 100};
constexpr PictureSize kModel = {.width_px = 60, .height_px = 40};

class CorrespondenceCsv : public testing::FileTest {
 protected:
  std::vector<Correspondence> read(const std::string& rows) const {
    return read_correspondences(file("pairs.csv", kHeader + rows), kSketch, kModel);
  }
  auto reading(const std::string& rows) const {
    return [this, rows] { read(rows); };
  }
};

TEST_F(CorrespondenceCsv, IsTurnedFromTheImageOfEachPictureToYUp) {
  const std::vector<Correspondence> pairs = read("7,sketch,0,0\n7,model,39,59\n");
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].match, 7U);
  EXPECT_EQ(pairs[0].point_in_sketch, Eigen::Vector2d(0.5, 99.5));
  EXPECT_EQ(pairs[0].point_in_model, Eigen::Vector2d(59.5, 0.5));
}

TEST_F(CorrespondenceCsv, TakesTheMeanOfTheParts) {
  const std::vector<Correspondence> pairs = read("0,sketch,10,20\n0,model,5,6\n0,sketch,20,40\n");
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].point_in_sketch, Eigen::Vector2d(30.5, 84.5));
}

TEST_F(CorrespondenceCsv, LeavesOutWhatIsInOnePictureOnly) {
  const std::vector<Correspondence> pairs =
      read("1,model,1,1\n2,sketch,2,2\n2,model,2,2\n3,sketch,3,3\n");
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].match, 2U);
}

TEST_F(CorrespondenceCsv, SaysWhatIsWrongAndWhere) {
  EXPECT_THAT(reading("0,map,1,1\n"),
              FailsWith("pairs.csv:2: drawing: expected sketch or model, found \"map\""));
  EXPECT_THAT(reading("0,sketch,1,1\n0,model,40,1\n"),
              FailsWith("pairs.csv:3: row: expected a number in [0, 39], found \"40\""));
  EXPECT_THAT(reading("0,sketch,1,-1\n"), FailsWith("column: expected a number in [0, 199]"));
  EXPECT_THAT(reading("0,sketch,nan,1\n"), FailsWith("row: expected a number in [0, 99]"));
  EXPECT_THAT(reading("-1,sketch,1,1\n"), FailsWith("match: expected an integer from 0 on"));
  EXPECT_THAT(reading("0,sketch,1\n"), FailsWith("columns: expected 4 as in the header"));
  EXPECT_THAT(reading(""), FailsWith("rows: expected at least one"));
}

TEST_F(CorrespondenceCsv, NeedsItsColumns) {
  const std::filesystem::path path = file("pairs.csv", "match,row,column\n0,1,1\n");
  EXPECT_THAT([&] { read_correspondences(path, kSketch, kModel); },
              FailsWith("pairs.csv:1: header: expected one column \"drawing\""));
}

}  // namespace
}  // namespace sketchloc
