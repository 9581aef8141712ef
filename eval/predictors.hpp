#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "registration/network_predictor.hpp"
#include "registration/warp_predictor.hpp"

namespace sketchloc {

/// Ways to register scans in drawings, as people name them.
enum class RegistrationMethod {
  Ours,
  Chen20,  ///< the published network
  Affine,  ///< its sister without bending
  Icp      ///< no network: features, then iterative closest points
};
std::span<const std::pair<std::string_view, RegistrationMethod>> names_of(RegistrationMethod);

/// The network that a method runs; none: it runs none.
std::optional<NetworkKind> network_of(RegistrationMethod method);

/// Does the method look at the present scan only, whatever the submap?
bool takes_one_scan(RegistrationMethod method);

/// The predictor of a method, from a network given as the bytes of an ONNX file or else from the
/// one that comes with the program. Throws std::invalid_argument where a network is given to a
/// method that runs none, or is needed and neither given nor there; std::runtime_error where the
/// bytes are no network of that kind.
std::unique_ptr<WarpPredictor> make_predictor(
    RegistrationMethod method, std::optional<std::span<const std::uint8_t>> onnx = std::nullopt,
    const NetworkPredictorParams& params = {});

}  // namespace sketchloc
