#pragma once

#include <stdexcept>
#include <string>

namespace sketchloc {

/// Thrown at the next safe place after Ctrl-C, so that half-made outputs are removed.
struct Interrupted : std::runtime_error {
  explicit Interrupted(const std::string& what = "interrupted; nothing was written")
      : std::runtime_error(what) {}
};

/// From now on the first Ctrl-C or SIGTERM asks for a clean end, a second one ends at once.
void catch_interrupts();

/// Whether an end was asked for.
bool end_was_asked_for();

/// Throws Interrupted where an end was asked for. Long loops call it now and then.
void throw_if_interrupted();

}  // namespace sketchloc
