#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace sketchloc {

/// Says each kind of thing at most once in a while, and how often it was not said. Reads no clock.
class Complaints {
 public:
  explicit Complaints(double every_s) : every_s_(every_s) {}

  /// What to say now; none: nothing.
  std::optional<std::string> about(const std::string& kind, const std::string& what, double now_s);

 private:
  struct Kind {
    double said_s = 0.0;
    std::uint64_t unsaid = 0;
  };

  double every_s_;
  std::map<std::string, Kind> kinds_;
};

}  // namespace sketchloc
