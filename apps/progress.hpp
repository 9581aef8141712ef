#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <iosfwd>
#include <string>

namespace sketchloc {

/// How far a long piece of work is: on a terminal one line with share and time left, redrawn ten
/// times a second; elsewhere a line for every tenth of the work. Silent under --quiet.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;
  struct Sink {
    std::ostream* out;
    bool is_terminal = false;
    std::function<Clock::time_point()> now = Clock::now;
  };

  /// `what` is a verb, such as "localize". Writes to stderr.
  Progress(std::string what, std::size_t total);
  Progress(std::string what, std::size_t total, Sink sink);
  ~Progress();  ///< leaves the terminal with a whole line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// So many of the total are done. Throws Interrupted after Ctrl-C.
  void update(std::size_t done);

 private:
  void draw(std::size_t done, Clock::time_point now);

  std::string what_;
  std::size_t total_;
  Sink sink_;
  Clock::time_point start_;
  Clock::time_point last_drawn_;
  std::size_t tenths_said_ = 0;
  bool line_open_ = false;
};

}  // namespace sketchloc
