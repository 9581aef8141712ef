// Places that correspond between a drawing and a model.

#include <stdexcept>

#include "datasets/io/correspondence_io.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sketchloc;
  const fuzz::InputFile input({data, size});
  try {
    for (const Correspondence& pair : read_correspondences(
             input.path(), {.width_px = 100, .height_px = 80}, {.width_px = 50, .height_px = 40})) {
      fuzz::require((pair.point_in_sketch.array() > 0.0).all(), "points lie in the sketch");
      fuzz::require(pair.point_in_model.x() < 50.0 && pair.point_in_model.y() < 40.0,
                    "points lie in the model");
    }
  } catch (const std::runtime_error&) {
  }
  return 0;
}
