// Pose graphs.

#include <cmath>
#include <stdexcept>

#include "datasets/io/g2o_io.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sketchloc;
  const fuzz::InputFile input({data, size});
  try {
    const PoseGraph graph = read_g2o(input.path());
    validate(graph);
    fuzz::require(!g2o_text(graph).empty(), "what was read can be written");
  } catch (const std::runtime_error&) {
  }
  return 0;
}
