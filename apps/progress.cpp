#include "apps/progress.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

#include "apps/interrupt.hpp"

namespace sketchloc {
namespace {

using Seconds = std::chrono::duration<double>;

Progress::Sink standard_error() {
  const bool wanted = spdlog::should_log(spdlog::level::info);
  return {.out = wanted ? &std::cerr : nullptr, .is_terminal = ::isatty(STDERR_FILENO) == 1};
}

/// 75 -> "1:15 min", 4.2 -> "5 s".
std::string duration_text(double duration_s) {
  const long whole_s = std::lround(std::ceil(duration_s));
  std::ostringstream text;
  if (whole_s < 60) {
    text << whole_s << " s";
  } else if (whole_s < 3600) {
    text << whole_s / 60 << ":" << std::setw(2) << std::setfill('0') << whole_s % 60 << " min";
  } else {
    text << whole_s / 3600 << ":" << std::setw(2) << std::setfill('0') << whole_s / 60 % 60 << " h";
  }
  return text.str();
}

}  // namespace

Progress::Progress(std::string what, std::size_t total)
    : Progress(std::move(what), total, standard_error()) {}

Progress::Progress(std::string what, std::size_t total, Sink sink)
    : what_(std::move(what)),
      total_(total),
      sink_(std::move(sink)),
      start_(sink_.now()),
      last_drawn_(start_) {}

Progress::~Progress() {
  if (line_open_) {
    *sink_.out << std::endl;
  }
}

void Progress::update(std::size_t done) {
  throw_if_interrupted();
  if (sink_.out == nullptr || total_ == 0) {
    return;
  }
  const Clock::time_point now = sink_.now();
  const bool finished = done >= total_;
  const std::size_t tenths = 10 * done / total_;
  const bool due =
      sink_.is_terminal ? finished || now - last_drawn_ >= Seconds(0.1) : tenths > tenths_said_;
  if (due) {
    tenths_said_ = tenths;
    last_drawn_ = now;
    draw(done, now);
  }
}

void Progress::draw(std::size_t done, Clock::time_point now) {
  const double share = static_cast<double>(done) / static_cast<double>(total_);
  const double elapsed_s = Seconds(now - start_).count();
  std::ostringstream line;
  line << what_ << " " << std::setw(3) << static_cast<int>(100.0 * share) << " %";
  if (done >= total_) {
    line << ", took " << duration_text(elapsed_s);
  } else if (done > 0) {
    line << ", " << duration_text(elapsed_s / share - elapsed_s) << " left";
  }
  if (sink_.is_terminal) {
    *sink_.out << '\r' << line.str() << "\x1b[K" << std::flush;
    line_open_ = true;
  } else {
    *sink_.out << line.str() << std::endl;
  }
}

}  // namespace sketchloc
