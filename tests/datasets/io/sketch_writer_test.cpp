#include "datasets/io/sketch_writer.hpp"

#include <gtest/gtest.h>

#include "datasets/io/sketch_io.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc {
namespace {

/// A lopsided room, so that any turn or mirroring shows.
Sketch room() {
  Sketch sketch{.occupied = Grid<std::uint8_t>(80, 60), .px_per_m = std::nullopt};
  for (int column = 10; column < 70; ++column) {
    sketch.occupied.at({column, 5}) = 1;
    sketch.occupied.at({column, 50}) = column < 40 ? 1 : 0;
  }
  for (int row = 5; row <= 50; ++row) {
    sketch.occupied.at({10, row}) = 1;
    sketch.occupied.at({40, row}) = row > 20 ? 1 : 0;
  }
  return sketch;
}

TEST(SketchWriter, WritesWhatTheReaderReads) {
  const testing::TemporaryDirectory folder;
  write_sketch(folder / "drawing.png", room());
  const Sketch read = read_sketch(folder / "drawing.png");
  EXPECT_EQ(read.kind, Sketch::Kind::Strokes);
  EXPECT_EQ(read.occupied, room().occupied);
}

TEST(SketchWriter, DrawsAPathEvenIfItIsEmpty) {
  const testing::TemporaryDirectory folder;
  write_path_picture(folder / "empty.png", room(), {});
  const std::vector<Eigen::Vector2d> path = {{20.0, 10.0}, {30.0, 40.0}, {200.0, 40.0}};
  write_path_picture(folder / "path.png", room(), path);
  EXPECT_GT(std::filesystem::file_size(folder / "path.png"),
            std::filesystem::file_size(folder / "empty.png"));
}

}  // namespace
}  // namespace sketchloc
