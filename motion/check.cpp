#include "motion/check.hpp"

#include <cstdio>
#include <cstdlib>
#include <string>

namespace sketchloc {

void check_failed(std::string_view what, const std::source_location& where) {
  std::fprintf(stderr, "%s:%u: contract broken in %s: %s\n", where.file_name(),
               static_cast<unsigned>(where.line()), where.function_name(),
               std::string(what).c_str());
  std::abort();
}

}  // namespace sketchloc
