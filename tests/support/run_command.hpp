#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sketchloc::testing {

struct CommandResult {
  int exit_code = -1;  ///< -1 where it ended by a signal
  std::string out;
  std::string err;
};

/// The bytes of a file; none where it is not there.
std::string content_of(const std::filesystem::path& file);

/// Runs a program with arguments, without a shell and without stdin, and waits for it.
CommandResult run_command(const std::vector<std::string>& command);

}  // namespace sketchloc::testing
