#pragma once

#include <utility>

namespace sketchloc {

/// A file descriptor that is closed when nobody has it any more.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor();

  int number() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  void close() { *this = Descriptor(); }

 private:
  int number_ = -1;
};

/// Wakes a thread that waits in poll().
class WakeUp {
 public:
  /// Throws std::system_error where the system has no descriptors left.
  WakeUp();
  void ring();
  void hear();  ///< so that it can ring again
  int number() const { return bell_.number(); }

 private:
  Descriptor bell_;
};

}  // namespace sketchloc
