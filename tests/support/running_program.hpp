#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/support/run_command.hpp"
#include "tests/support/shared_data.hpp"

namespace sketchloc::testing {

/// A program that runs while the test talks to it. Killed when the test forgets it.
class RunningProgram {
 public:
  explicit RunningProgram(const std::vector<std::string>& command);
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  /// To its stdin; what it does not read any more is lost.
  void write(std::string_view text);
  void close_stdin();
  void send_signal(int signal) const;

  std::string out() const { return content_of(folder_ / "out"); }
  std::string err() const { return content_of(folder_ / "err"); }
  /// Waits until this holds, at most a minute; says whether it did.
  static bool wait_until(const std::function<bool()>& holds);

  /// Waits for the end; ends it by force after a minute.
  CommandResult wait();

 private:
  TemporaryDirectory folder_;
  pid_t child_ = -1;
  int stdin_ = -1;
};

/// Sends a text to a port of this machine, says that it is all, and gives what comes back until the
/// other side hangs up.
std::string exchange_by_tcp(int port, std::string_view text);

}  // namespace sketchloc::testing
