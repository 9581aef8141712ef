#pragma once

#include <span>
#include <string>

#include "registration/network_input.hpp"

namespace sketchloc::testing {

/// The bytes of an ONNX file whose network gives these numbers whatever it sees, in 64 x 64 cells.
/// Written without libonnx, so that every build can have one.
std::string constant_network(InputKind kind, std::span<const float> output);

}  // namespace sketchloc::testing
