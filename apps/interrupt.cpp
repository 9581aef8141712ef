#include "apps/interrupt.hpp"

#include <csignal>

namespace sketchloc {
namespace {

volatile std::sig_atomic_t end_asked_for = 0;

void ask_for_end(int signal) {
  end_asked_for = 1;
  std::signal(signal, SIG_DFL);
}

}  // namespace

void catch_interrupts() {
  end_asked_for = 0;
  std::signal(SIGINT, ask_for_end);
  std::signal(SIGTERM, ask_for_end);
}

bool end_was_asked_for() { return end_asked_for != 0; }

void throw_if_interrupted() {
  if (end_was_asked_for()) {
    throw Interrupted();
  }
}

}  // namespace sketchloc
