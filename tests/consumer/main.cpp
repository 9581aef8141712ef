#include <iostream>

#include "datasets/io/sketch_io.hpp"
#include "filter/localizer.hpp"

int main(int argc, char** argv) {
  if (argc < 2) {
    return 0;  // no drawing at hand: that it links is what counts
  }
  const sketchloc::Localizer localizer(sketchloc::read_sketch(argv[1]), {});
  std::cout << localizer.particles().size() << " particles\n";
}
