#include "datasets/io/sketch_io.hpp"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "datasets/io/sketch_writer.hpp"
#include "tests/datasets/io/drawings.hpp"
#include "tests/datasets/io/files.hpp"

namespace sketchloc {
namespace {

using testing::content_of;
using testing::drawn_strokes;
using testing::FailsWith;
using testing::overlap;
using testing::painted_rooms;
using testing::photo_of;
using testing::picture_of;
using Kind = Sketch::Kind;
using Polarity = SketchReading::Polarity;

cv::Mat1b inverse(const cv::Mat1b& mask) {
  cv::Mat1b out;
  cv::bitwise_not(mask, out);
  return out;
}

class ReadSketch : public testing::FileTest {
 protected:
  std::filesystem::path picture(const std::string& name, const cv::Mat& pixels,
                                const std::vector<int>& how = {}) const {
    cv::imwrite(missing(name).string(), pixels, how);
    return missing(name);
  }
  Sketch read(const std::string& name, const cv::Mat& pixels,
              const SketchReading& reading = {}) const {
    return read_sketch(picture(name, pixels), reading);
  }
};

TEST_F(ReadSketch, PutsTheLowerLeftPixelFirst) {
  cv::Mat1b strokes = inverse(cv::Mat1b(60, 80, static_cast<unsigned char>(0)));
  cv::line(strokes, {0, 50}, {30, 50}, 0, 1);
  const Sketch sketch = read("a.png", strokes);
  EXPECT_EQ(sketch.width_px(), 80);
  EXPECT_EQ(sketch.height_px(), 60);
  EXPECT_EQ(sketch.occupied.at({0, 9}), 1);
  EXPECT_EQ(sketch.occupied.at({31, 9}), 0);
  EXPECT_EQ(sketch.occupied.at({0, 50}), 0);
  EXPECT_FALSE(sketch.px_per_m);
}

TEST_F(ReadSketch, FindsStrokesOfEitherPolarityInEveryFormat) {
  const cv::Mat1b strokes = drawn_strokes();
  for (const char* name : {"a.png", "a.jpg", "a.pgm"}) {
    for (const auto& [ink, ground] : {std::pair(20, 240), std::pair(250, 5), std::pair(200, 120)}) {
      const Sketch sketch = read(name, picture_of(strokes, ink, ground));
      EXPECT_EQ(sketch.kind, Kind::Strokes) << name << " " << ink;
      EXPECT_GT(overlap(sketch, strokes), 0.9) << name << " " << ink;
    }
  }
}

TEST_F(ReadSketch, FindsPaintedFreeSpaceOfEitherPolarity) {
  const cv::Mat1b rooms = painted_rooms();
  for (const auto& [free, ground] : {std::pair(255, 0), std::pair(0, 255), std::pair(250, 200)}) {
    const Sketch sketch = read("a.png", picture_of(rooms, free, ground));
    EXPECT_EQ(sketch.kind, Kind::FilledFreeSpace) << free;
    EXPECT_GT(overlap(sketch, inverse(rooms)), 0.99) << free;
  }
}

TEST_F(ReadSketch, TakesGreyWallsInsidePaintedFreeSpaceForObstacles) {
  cv::Mat1b map = picture_of(painted_rooms(), 255, 176);
  cv::line(map, {150, 90}, {150, 105}, 210, 3);
  cv::line(map, {60, 100}, {100, 100}, 0, 1);
  const Sketch sketch = read("a.png", map);
  EXPECT_EQ(sketch.kind, Kind::FilledFreeSpace);
  EXPECT_EQ(sketch.occupied.at({150, 199 - 95}), 1);
  EXPECT_EQ(sketch.occupied.at({80, 199 - 100}), 1);
  EXPECT_EQ(sketch.occupied.at({80, 199 - 103}), 0);
}

TEST_F(ReadSketch, LetsTheCallerOverrideKindAndPolarity) {
  const cv::Mat1b rooms = painted_rooms();
  const cv::Mat1b picture = picture_of(rooms, 255, 0);
  EXPECT_EQ(read("a.png", picture, {.kind = Kind::Strokes}).kind, Kind::Strokes);
  const Sketch inside_out =
      read("a.png", picture, {.polarity = Polarity::DarkOnLight, .kind = Kind::FilledFreeSpace});
  EXPECT_GT(overlap(inside_out, rooms), 0.99);
}

TEST_F(ReadSketch, FollowsUnevenLightOnAPhotoOfPaper) {
  const cv::Mat1b strokes = drawn_strokes(3);
  const Sketch sketch = read("photo.jpg", photo_of(strokes, false));
  EXPECT_EQ(sketch.kind, Kind::Strokes);
  EXPECT_GT(overlap(sketch, strokes), 0.85);
}

TEST_F(ReadSketch, RemovesSpecksOfDirt) {
  const cv::Mat1b strokes = drawn_strokes(3);
  cv::Mat1b near;
  cv::dilate(strokes, near, cv::Mat(), cv::Point(-1, -1), 3);
  const Sketch sketch = read("photo.png", photo_of(strokes, true));
  for (int row = 0; row < near.rows; ++row) {
    for (int column = 0; column < near.cols; ++column) {
      const bool dirt =
          near(row, column) == 0 && sketch.occupied.at({column, near.rows - 1 - row}) != 0;
      ASSERT_FALSE(dirt) << "row " << row << " column " << column;
    }
  }
}

TEST_F(ReadSketch, KeepsSmallPostsUnlessTheyAreSmallerThanDirt) {
  cv::Mat1b picture = picture_of(drawn_strokes(), 0, 255);
  cv::rectangle(picture, {150, 140}, {153, 143}, 0, cv::FILLED);
  EXPECT_EQ(read("a.png", picture).occupied.at({151, 199 - 141}), 1);
  EXPECT_EQ(read("a.png", picture, {.dirt_px = 6.0}).occupied.at({151, 199 - 141}), 0);
}

TEST_F(ReadSketch, SeesInkOfAnyColour) {
  const cv::Mat1b strokes = drawn_strokes();
  for (const cv::Scalar& ink :
       {cv::Scalar(0, 0, 255), cv::Scalar(255, 0, 0), cv::Scalar(0, 220, 255)}) {
    cv::Mat3b picture(strokes.size(), cv::Vec3b(255, 255, 255));
    picture.setTo(ink, strokes);
    EXPECT_GT(overlap(read("a.png", picture), strokes), 0.99) << ink;
  }
}

TEST_F(ReadSketch, PutsTransparentDrawingsOnPaperOfTheOtherLightness) {
  const cv::Mat1b strokes = drawn_strokes();
  for (const int ink : {0, 255}) {
    cv::Mat4b picture(strokes.size(), cv::Vec4b(0, 0, 0, 0));
    picture.setTo(cv::Scalar(ink, ink, ink, 255), strokes);
    EXPECT_GT(overlap(read("a.png", picture), strokes), 0.99) << ink;
  }
}

TEST_F(ReadSketch, ReadsSixteenBitPictures) {
  cv::Mat picture;
  picture_of(drawn_strokes(), 0, 255).convertTo(picture, CV_16U, 257.0);
  EXPECT_GT(overlap(read("a.png", picture), drawn_strokes()), 0.99);
}

TEST_F(ReadSketch, RefusesABlankPicture) {
  for (const int level : {0, 128, 255}) {
    const cv::Mat1b blank(50, 50, static_cast<unsigned char>(level));
    EXPECT_THAT([&] { read("blank.png", blank); }, FailsWith("found a blank picture")) << level;
  }
  const cv::Mat1b noise =
      picture_of(cv::Mat1b(200, 300, static_cast<unsigned char>(0)), 0, 200, 3.0);
  EXPECT_THAT([&] { read("blank.png", noise); }, FailsWith("found a blank picture"));
}

TEST_F(ReadSketch, RefusesPicturesThatAreHugeOrSaySo) {
  EXPECT_THAT([&] { read("a.png", drawn_strokes(), {.max_pixels = 1000}); },
              FailsWith("a.png: size: expected 1 to 1000 pixels, found 300 x 200"));
  EXPECT_THAT([&] { read_sketch(file("a.pgm", "P5 1000000 1000000 255\nx")); },
              FailsWith("found 1000000 x 1000000"));
  std::string png = content_of(picture("b.png", drawn_strokes()));
  png.replace(16, 8, "\x7f\xff\xff\xff\x7f\xff\xff\xff");
  EXPECT_THAT([&] { read_sketch(file("b.png", png)); }, FailsWith("size: expected 1 to"));
}

TEST_F(ReadSketch, RefusesWhatIsNotAWholePicture) {
  EXPECT_THAT([&] { read_sketch(missing("no.png")); }, FailsWith("no.png: cannot be opened"));
  EXPECT_THAT([&] { read_sketch(file("empty.png", "")); }, FailsWith("empty file"));
  EXPECT_THAT([&] { read_sketch(folder()); }, FailsWith("folder"));
  EXPECT_THAT([&] { read_sketch(file("a.png", "no picture at all")); },
              FailsWith("expected a PNG, JPEG or PGM picture"));
  for (const char* name : {"a.png", "a.jpg", "a.pgm"}) {
    const std::string whole = content_of(picture(name, picture_of(drawn_strokes(), 0, 255)));
    for (const std::size_t left : {whole.size() / 4, whole.size() / 2, whole.size() - 3}) {
      EXPECT_THAT([&] { read_sketch(file(name, whole.substr(0, left))); },
                  FailsWith("it is damaged, cut off"))
          << name << " " << left << " of " << whole.size();
    }
  }
}

TEST_F(ReadSketch, GivesBackWhatWasWritten) {
  for (const cv::Mat1b& mask : {drawn_strokes(), inverse(painted_rooms())}) {
    const Sketch sketch = read("a.png", inverse(mask));
    write_sketch(missing("b.png"), sketch);
    const Sketch back = read_sketch(missing("b.png"));
    EXPECT_EQ(back.kind, sketch.kind);
    EXPECT_EQ(back.occupied, sketch.occupied);
    EXPECT_EQ(overlap(back, mask), 1.0);
  }
}

TEST_F(ReadSketch, ReadsPicturesOfAFewPixels) {
  for (const cv::Size& size : {cv::Size(1, 1), cv::Size(1, 7), cv::Size(9, 1), cv::Size(3, 3)}) {
    cv::Mat1b picture(size, static_cast<unsigned char>(255));
    picture(0, 0) = 0;
    try {
      EXPECT_EQ(read("a.png", picture).width_px(), size.width);
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("found a blank picture"));
    }
  }
}

}  // namespace
}  // namespace sketchloc
