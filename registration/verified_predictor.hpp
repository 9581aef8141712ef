#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "registration/local_window.hpp"
#include "registration/warp_predictor.hpp"

namespace sketchloc {

/// What the verification network tells: wrong, right. Their difference is the log odds that the
/// robot is within kVerified_m and kVerified_rad of the pose.
inline constexpr int kVerificationOutputs = 2;
inline constexpr double kVerified_m = 2.0;
inline constexpr double kVerified_rad = 0.5236;

/// A predictor whose registrations are looked at once more by the verification network, which knows
/// what places look like where the robot is not: it gives them their place_log_odds. The network is
/// given as the bytes of an ONNX file and looks through `window`, the one that it was trained with.
/// Not safe to share between threads. Throws std::runtime_error where the bytes are no such
/// network.
std::unique_ptr<WarpPredictor> make_verified_predictor(std::unique_ptr<WarpPredictor> predictor,
                                                       std::span<const std::uint8_t> onnx,
                                                       const LocalWindow& window = {});

}  // namespace sketchloc
