#pragma once

#include <span>
#include <string>

namespace sketchloc::testing {

/// The bytes of an ONNX file whose network gives these numbers whatever it sees, for inputs of so
/// many channels and 64 x 64 cells. Written without libonnx, so that every build can have one.
std::string constant_network(int channels, std::span<const float> output);

}  // namespace sketchloc::testing
