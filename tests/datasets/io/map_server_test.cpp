#include <opencv2/imgcodecs.hpp>

#include "datasets/io/sketch_io.hpp"
#include "tests/datasets/io/files.hpp"

namespace sketchloc {
namespace {

using testing::FailsWith;

constexpr const char* kYaml =
    "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
    "free_thresh: 0.196\n";

class MapServer : public testing::FileTest {
 protected:
  MapServer() {
    cv::Mat1b map(2, 3, static_cast<unsigned char>(254));  // free
    map(0, 0) = 0;                                         // occupied
    map(1, 2) = 205;                                       // unknown
    cv::imwrite(missing("map.pgm").string(), map);
  }
  std::filesystem::path yaml_with(std::string_view line, std::string_view replacement) const {
    std::string text = kYaml;
    const std::size_t start = text.find(line);
    return file("map.yaml", text.replace(start, line.size(), replacement));
  }
  auto reading(std::string_view line, std::string_view replacement) const {
    const std::filesystem::path yaml = yaml_with(line, replacement);
    return [yaml] { read_map_server(yaml); };
  }
};

TEST_F(MapServer, TellsOccupiedFromFreeAndUnknown) {
  const Sketch map = read_any_drawing(file("map.yaml", kYaml));
  EXPECT_DOUBLE_EQ(map.px_per_m.value(), 20.0);
  EXPECT_EQ(map.kind, Sketch::Kind::Strokes);
  EXPECT_EQ(map.occupied.at({0, 1}), 1);
  EXPECT_EQ(map.occupied.at({2, 0}), 0);
  EXPECT_EQ(map.occupied.at({1, 1}), 0);
}

TEST_F(MapServer, NegatesAndMovesTheThreshold) {
  EXPECT_EQ(read_map_server(yaml_with("negate: 0", "negate: 1")).occupied.at({1, 0}), 1);
  const Sketch low = read_map_server(yaml_with("occupied_thresh: 0.65\nfree_thresh: 0.196",
                                               "occupied_thresh: 0.19\nfree_thresh: 0.1"));
  EXPECT_EQ(low.occupied.at({2, 0}), 1);
}

TEST_F(MapServer, NamesFileLineAndField) {
  EXPECT_THAT(reading("resolution: 0.05", "resolution: x"),
              FailsWith("map.yaml:2: resolution: expected a number"));
  EXPECT_THAT(reading("resolution: 0.05", "resolution: 0"), FailsWith("map.yaml:2: resolution"));
  EXPECT_THAT(reading("resolution: 0.05", "resolution: .nan"), FailsWith("resolution: expected"));
  EXPECT_THAT(reading("image: map.pgm\n", ""), FailsWith("image: expected a value, found nothing"));
  EXPECT_THAT(reading("map.pgm", "none.pgm"), FailsWith("none.pgm: cannot be opened"));
  EXPECT_THAT(reading("negate: 0", "negate: maybe"),
              FailsWith("map.yaml:4: negate: expected 0 or 1"));
  EXPECT_THAT(reading("free_thresh: 0.196", "free_thresh: 0.9"),
              FailsWith("free_thresh: expected"));
  EXPECT_THAT(reading("negate: 0", "mode: raw"), FailsWith("mode: expected trinary or scale"));
  EXPECT_THAT(reading("origin: [", "origin: [["), FailsWith("YAML"));
  EXPECT_THAT([&] { read_map_server(file("list.yaml", "- 1\n- 2\n")); }, FailsWith("YAML map"));
  EXPECT_THAT([&] { read_map_server(file("big.yaml", std::string(2'000'000, ' '))); },
              FailsWith("size: expected at most"));
}

TEST_F(MapServer, RefusesAMapWithoutObstacles) {
  cv::imwrite(missing("map.pgm").string(), cv::Mat1b(4, 4, static_cast<unsigned char>(254)));
  EXPECT_THAT([&] { read_map_server(file("map.yaml", kYaml)); },
              FailsWith("expected occupied cells, found none"));
}

}  // namespace
}  // namespace sketchloc
