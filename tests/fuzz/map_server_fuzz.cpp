// The YAML file of map_server, beside a picture that is whole.

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "datasets/io/sketch_io.hpp"
#include "tests/fuzz/input_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sketchloc;
  static const fuzz::InputFolder folder;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (text.find('/') != std::string_view::npos) {
    return 0;  // stay in the folder
  }
  if (!std::filesystem::exists(folder.path() / "map.pgm")) {
    std::ofstream(folder.path() / "map.pgm") << "P2 3 2 255\n0 254 254 254 254 205\n";
  }
  std::ofstream(folder.path() / "map.yaml", std::ios::binary) << text;
  try {
    const Sketch map = read_map_server(folder.path() / "map.yaml");
    fuzz::require(map.px_per_m && std::isfinite(*map.px_per_m) && *map.px_per_m > 0.0,
                  "a metric map has a scale");
  } catch (const std::runtime_error&) {
  }
  return 0;
}
