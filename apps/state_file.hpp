#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

namespace sketchloc {

/// The bytes of a state file. `what`: all that the state depends on, in lines `name: value`.
std::string state_file_bytes(std::string_view what, std::string_view state);

/// The state in the bytes of a state file. Throws std::runtime_error naming `file` and why it is
/// none, is damaged, is of another version, or of something else than `what` (the first line that
/// differs).
std::string state_in(std::string_view bytes, std::string_view what,
                     const std::filesystem::path& file);

/// Keeps states in a file, each whole or not at all, in a thread of its own: flushing to the disk
/// takes longer than a scan may.
class StateKeeper {
 public:
  StateKeeper(std::filesystem::path file, std::string what);
  /// Waits until the last state is written.
  ~StateKeeper();
  StateKeeper(const StateKeeper&) = delete;
  StateKeeper& operator=(const StateKeeper&) = delete;

  /// Soon; one that is not written yet is given up for a newer one.
  void keep(std::string state);
  /// Waits until all is written.
  void flush();

  std::uint64_t written() const;
  /// What went wrong since the last call.
  std::optional<std::string> complaint();

 private:
  void write_all();

  std::filesystem::path file_;
  std::string what_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<std::string> next_;
  bool writing_ = false;
  bool ended_ = false;
  std::uint64_t written_ = 0;
  std::optional<std::string> complaint_;
  std::thread writer_;  // last, so that everything else is there before it starts
};

}  // namespace sketchloc
