#include "apps/fingerprint.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>

#include "apps/read_bytes.hpp"

namespace sketchloc {

/// Eight bytes at a time through the finalizer of SplitMix64, as the program itself is hundreds of
/// megabytes.
std::string fingerprint(std::span<const std::byte> bytes) {
  std::uint64_t state = bytes.size();
  for (std::size_t i = 0; i < bytes.size(); i += sizeof(std::uint64_t)) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
    state = (state ^ word) + 0x9E3779B97F4A7C15;
    state = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9;
    state = (state ^ (state >> 27)) * 0x94D049BB133111EB;
    state ^= state >> 31;
  }
  return fmt::format("{:016x}", state);
}

std::string fingerprint_of_file(const std::filesystem::path& file) {
  const std::optional<std::string> bytes = read_bytes(file);
  return bytes ? fingerprint(std::as_bytes(std::span(*bytes))) : "none";
}

}  // namespace sketchloc
