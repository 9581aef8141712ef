#include "apps/state_file.hpp"

#include <span>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "apps/fingerprint.hpp"
#include "datasets/io/atomic_file.hpp"
#include "motion/state_bytes.hpp"

namespace sketchloc {
namespace {

constexpr std::string_view kMagic = "sketchloc state\n";
constexpr std::uint32_t kVersion = 4;
constexpr std::size_t kMostBytes = std::size_t{1} << 30;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what);
}

/// The first lines that are not the same.
std::string difference(const std::string& then, std::string_view now) {
  std::istringstream then_lines(then);
  std::istringstream now_lines{std::string(now)};
  std::string then_line;
  std::string now_line;
  do {
    const bool had = static_cast<bool>(std::getline(then_lines, then_line));
    const bool has = static_cast<bool>(std::getline(now_lines, now_line));
    then_line = had ? then_line : "nothing";
    now_line = has ? now_line : "nothing";
  } while (then_line == now_line);
  return "it was kept with `" + then_line + "`, now there is `" + now_line + "`";
}

constexpr const char* kAdvice =
    "; resume with the same drawing and options, or begin anew with another --state or with "
    "--force "
    "instead of --resume";

std::string print_of(std::string_view content) {
  return fingerprint(std::as_bytes(std::span(content)));
}

}  // namespace

std::string state_file_bytes(std::string_view what, std::string_view state) {
  StateWriter content;
  content.put_text(what);
  content.put_text(state);
  StateWriter file;
  file.put(kVersion);
  file.put_text(print_of(content.bytes()));
  file.put_text(content.bytes());
  return std::string(kMagic) + file.bytes();
}

std::string state_in(std::string_view bytes, std::string_view what,
                     const std::filesystem::path& file) {
  if (!bytes.starts_with(kMagic)) {
    fail(file, "is no state that sketchloc track kept; give another --state");
  }
  StateReader whole(bytes.substr(kMagic.size()));
  try {
    if (const auto version = whole.get<std::uint32_t>(); version != kVersion) {
      fail(file, "is a state of version " + std::to_string(version) +
                     ", this program keeps version " + std::to_string(kVersion) + kAdvice);
    }
    const std::string print = whole.get_text(kMostBytes);
    const std::string content = whole.get_text(kMostBytes);
    if (!whole.at_end() || print_of(content) != print) {
      fail(file, std::string("is damaged") + kAdvice);
    }
    StateReader parts(content);
    const std::string then = parts.get_text(kMostBytes);
    if (then != what) {
      fail(file, "is of another run: " + difference(then, what) + kAdvice);
    }
    return parts.get_text(kMostBytes);
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    if (text.starts_with(file.string())) {
      throw;
    }
    fail(file, text + kAdvice);
  }
}

StateKeeper::StateKeeper(std::filesystem::path file, std::string what)
    : file_(std::move(file)), what_(std::move(what)), writer_([this] { write_all(); }) {}

StateKeeper::~StateKeeper() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }
  writer_.join();
}

void StateKeeper::keep(std::string state) {
  const std::lock_guard lock(mutex_);
  next_ = std::move(state);
  changed_.notify_all();
}

void StateKeeper::flush() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !next_ && !writing_; });
}

void StateKeeper::write_all() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ended_ || next_; });
    if (!next_) {
      return;
    }
    const std::string state = *std::exchange(next_, std::nullopt);
    writing_ = true;
    lock.unlock();
    std::optional<std::string> problem;
    try {
      write_atomically(file_, state_file_bytes(what_, state));
    } catch (const std::exception& error) {
      problem = error.what();
    }
    lock.lock();
    writing_ = false;
    written_ += problem ? 0 : 1;
    complaint_ = problem ? problem : complaint_;
    changed_.notify_all();
  }
}

std::uint64_t StateKeeper::written() const {
  const std::lock_guard lock(mutex_);
  return written_;
}

std::optional<std::string> StateKeeper::complaint() {
  const std::lock_guard lock(mutex_);
  return std::exchange(complaint_, std::nullopt);
}

}  // namespace sketchloc
