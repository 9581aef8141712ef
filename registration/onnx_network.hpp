#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace sketchloc {

/// Numbers for one input of a network, for one sample or several side by side.
struct NetworkPlanes {
  const char* input = "";  ///< its name in the file
  int channels = 1;
  int cells = 1;  ///< per side
  std::span<const float> values = {};
};

/// A network in the bytes of an ONNX file, run by OpenCV; also with the operation of ours
/// (detail/match_layer.hpp). Not safe to share between threads.
class OnnxNetwork {
 public:
  /// Throws std::runtime_error where the bytes are no network.
  explicit OnnxNetwork(std::span<const std::uint8_t> onnx);
  ~OnnxNetwork();
  OnnxNetwork(OnnxNetwork&&) noexcept;
  OnnxNetwork& operator=(OnnxNetwork&&) noexcept;

  /// Rows of outputs, one after the other. Throws std::runtime_error where these are not its
  /// inputs.
  std::vector<float> run(std::span<const NetworkPlanes> inputs);

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace sketchloc
