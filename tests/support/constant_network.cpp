#include "tests/support/constant_network.hpp"

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <vector>

#include "registration/correlation.hpp"

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

std::string integers_attribute(const std::string& name,
                               std::initializer_list<std::uint64_t> values) {
  constexpr std::uint64_t kIntegers = 7;
  std::string content = bytes(1, name);
  for (const std::uint64_t value : values) {
    content += number(8, value);
  }
  return bytes(5, content + number(20, kIntegers));
}

/// One plane of zeros from so many.
std::string nothing_of(const char* input, std::uint64_t planes, const std::string& output) {
  const std::string weights = output + "_weights";
  const std::vector<float> zeros(planes, 0.0F);
  return node("Conv", {input, weights.c_str()}, output,
              integers_attribute("kernel_shape", {1, 1})) +
         tensor(weights, {1, planes, 1, 1}, zeros);
}

}  // namespace

std::string constant_network(InputKind kind, std::span<const float> output) {
  constexpr std::uint64_t kCells = 64;
  const auto channels = static_cast<std::uint64_t>(channels_of(kind));
  const auto scan_channels = static_cast<std::uint64_t>(scan_channels_of(kind));
  const auto input = [](const char* name, std::uint64_t planes) {
    return value_info(11, name, {1, planes, kCells, kCells});
  };
  std::string graph;
  std::uint64_t width = 1;
  if (kind == InputKind::Published) {
    graph = nothing_of(kStackedInput, channels, "seen") + input(kStackedInput, channels);
  } else {
    width = 2 + kCorrelationShifts;
    graph = nothing_of(kScanInput, scan_channels, "scan_features") +
            nothing_of(kDrawingInput, channels - scan_channels, "drawing_features") +
            node(kMatchOperation, {"scan_features", "drawing_features"}, "seen",
                 bytes(7, kOperationDomain)) +
            input(kScanInput, scan_channels) + input(kDrawingInput, channels - scan_channels);
  }
  const std::uint64_t outputs = output.size();
  const std::vector<float> zeros(width * outputs, 0.0F);
  graph += node("GlobalAveragePool", {"seen"}, "pooled") +
           node("Flatten", {"pooled"}, "flat", integer_attribute("axis", 1)) +
           node("Gemm", {"flat", "weights", "bias"}, "output", integer_attribute("transB", 1)) +
           bytes(2, "constant") + tensor("weights", {outputs, width}, zeros) +
           tensor("bias", {outputs}, output) + value_info(12, "output", {1, outputs});
  return number(1, 7) + bytes(7, graph) + bytes(8, number(2, 12)) +
         bytes(8, bytes(1, kOperationDomain) + number(2, 1));
}

}  // namespace sketchloc::testing
