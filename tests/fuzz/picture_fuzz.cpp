// Drawings: PNG, JPEG, PNM. The first byte of the input is the choice of options.

#include <stdexcept>

#include "datasets/io/sketch_io.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sketchloc;
  if (size == 0) {
    return 0;
  }
  SketchReading reading{.max_pixels = 10'000};
  if ((data[0] & 1) != 0) {
    reading.polarity = (data[0] & 2) != 0 ? SketchReading::Polarity::DarkOnLight
                                          : SketchReading::Polarity::LightOnDark;
  }
  if ((data[0] & 4) != 0) {
    reading.kind = (data[0] & 8) != 0 ? Sketch::Kind::Strokes : Sketch::Kind::FilledFreeSpace;
  }
  const fuzz::InputFile input({data + 1, size - 1});
  try {
    const Sketch sketch = read_sketch(input.path(), reading);
    std::size_t occupied = 0;
    for (const std::uint8_t cell : sketch.occupied.cells()) {
      fuzz::require(cell <= 1, "cells are 0 or 1");
      occupied += cell;
    }
    fuzz::require(occupied > 0, "a drawing has something drawn");
  } catch (const std::runtime_error&) {
  }
  return 0;
}
