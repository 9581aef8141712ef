#pragma once

#include <cstdint>
#include <span>

#include "registration/network_predictor.hpp"

namespace sketchloc {

/// The trained network of a kind that comes with the program, as the bytes of an ONNX file. Empty
/// where there is none.
std::span<const std::uint8_t> shipped_network(NetworkKind kind);

/// The same: the one that tells whether the robot is where its scans were registered.
std::span<const std::uint8_t> shipped_verification();

/// The same: the one that tells kinds of places, and the one that compares them (topology/).
std::span<const std::uint8_t> shipped_place_classifier();
std::span<const std::uint8_t> shipped_place_comparator();

}  // namespace sketchloc
