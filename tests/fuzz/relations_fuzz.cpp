// Relations of the SLAM benchmark.

#include <stdexcept>

#include "datasets/io/relations_io.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sketchloc;
  const fuzz::InputFile input({data, size});
  try {
    for (const Relation& relation : read_relations(input.path())) {
      fuzz::require(relation.first_from_second.translation().allFinite(), "motions are finite");
    }
  } catch (const std::runtime_error&) {
  }
  return 0;
}
