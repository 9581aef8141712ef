#pragma once

#include <string>

#include "eval/sketch_errors.hpp"

namespace sketchloc::detail {

/// What a person wants to know first: did it work?
struct Verdict {
  enum class Kind { Located, Partly, Lost, Unknown };
  Kind kind = Kind::Unknown;
  std::string headline;
};

/// Located: never lost and within 2 m in at least three quarters of the steps. Lost: lost at the
/// end. Partly: everything between. Unknown: nothing to compare with.
Verdict judge(const SketchErrors& errors, double loss_bound_m);

}  // namespace sketchloc::detail
