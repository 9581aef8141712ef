#include "tests/support/constant_network.hpp"

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <vector>

namespace sketchloc::testing {
namespace {

// Protocol buffers: a key (number of the field and wire type), then a varint, or a length and
// bytes.

std::string varint(std::uint64_t value) {
  std::string bytes;
  for (; value >= 0x80U; value >>= 7U) {
    bytes += static_cast<char>((value & 0x7FU) | 0x80U);
  }
  return bytes + static_cast<char>(value);
}

std::string number(std::uint64_t field, std::uint64_t value) {
  return varint(field << 3U) + varint(value);
}

std::string bytes(std::uint64_t field, const std::string& content) {
  return varint((field << 3U) | 2U) + varint(content.size()) + content;
}

std::string node(const std::string& type, std::initializer_list<const char*> inputs,
                 const std::string& output, const std::string& attributes = {}) {
  std::string content;
  for (const char* input : inputs) {
    content += bytes(1, input);
  }
  return bytes(1, content + bytes(2, output) + bytes(3, output) + bytes(4, type) + attributes);
}

std::string integer_attribute(const std::string& name, std::uint64_t value) {
  constexpr std::uint64_t kInteger = 2;
  return bytes(5, bytes(1, name) + number(3, value) + number(20, kInteger));
}

std::string tensor(const std::string& name, std::initializer_list<std::uint64_t> sizes,
                   std::span<const float> values) {
  constexpr std::uint64_t kFloat = 1;
  std::string content;
  for (const std::uint64_t size : sizes) {
    content += number(1, size);
  }
  std::string raw(values.size_bytes(), '\0');
  std::memcpy(raw.data(), values.data(), values.size_bytes());
  return bytes(5, content + number(2, kFloat) + bytes(8, name) + bytes(9, raw));
}

std::string value_info(std::uint64_t field, const std::string& name,
                       std::initializer_list<std::uint64_t> sizes) {
  constexpr std::uint64_t kFloat = 1;
  std::string shape;
  for (const std::uint64_t size : sizes) {
    shape += bytes(1, number(1, size));
  }
  return bytes(field, bytes(1, name) + bytes(2, bytes(1, number(1, kFloat) + bytes(2, shape))));
}

}  // namespace

std::string constant_network(int channels, std::span<const float> output) {
  constexpr std::uint64_t kCells = 64;
  const auto width = static_cast<std::uint64_t>(channels);
  const std::uint64_t outputs = output.size();
  const std::vector<float> zeros(width * outputs, 0.0F);
  const std::string graph =
      node("GlobalAveragePool", {"input"}, "pooled") +
      node("Flatten", {"pooled"}, "flat", integer_attribute("axis", 1)) +
      node("Gemm", {"flat", "weights", "bias"}, "output", integer_attribute("transB", 1)) +
      bytes(2, "constant") + tensor("weights", {outputs, width}, zeros) +
      tensor("bias", {outputs}, output) + value_info(11, "input", {1, width, kCells, kCells}) +
      value_info(12, "output", {1, outputs});
  return number(1, 7) + bytes(7, graph) + bytes(8, number(2, 12));
}

}  // namespace sketchloc::testing
