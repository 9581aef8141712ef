#include "eval/predictors.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "motion/check.hpp"
#include "registration/icp_predictor.hpp"
#include "registration/shipped_networks.hpp"
#include "registration/verified_predictor.hpp"

namespace sketchloc {
namespace {

std::string name_of(RegistrationMethod method) {
  const auto names = names_of(method);
  const auto found =
      std::ranges::find(names, method, [](const auto& named) { return named.second; });
  check(found != names.end(), "a method has a name");
  return std::string(found->first);
}

std::unique_ptr<WarpPredictor> make_without_network(RegistrationMethod method, bool network_given) {
  if (network_given) {
    throw std::invalid_argument(name_of(method) + " runs no network; give none");
  }
  return make_icp_predictor();
}

}  // namespace

std::span<const std::pair<std::string_view, RegistrationMethod>> names_of(RegistrationMethod) {
  static constexpr std::pair<std::string_view, RegistrationMethod> kNames[] = {
      {"ours", RegistrationMethod::Ours},
      {"chen20", RegistrationMethod::Chen20},
      {"affine", RegistrationMethod::Affine},
      {"icp", RegistrationMethod::Icp}};
  return kNames;
}

std::optional<NetworkKind> network_of(RegistrationMethod method) {
  switch (method) {
    case RegistrationMethod::Ours:
      return NetworkKind::Ours;
    case RegistrationMethod::Chen20:
      return NetworkKind::Chen20;
    case RegistrationMethod::Affine:
      return NetworkKind::Affine;
    case RegistrationMethod::Icp:
      return std::nullopt;
  }
  check(false, "a method of registration");
  return std::nullopt;
}

bool takes_one_scan(RegistrationMethod method) {
  return method == RegistrationMethod::Chen20 || method == RegistrationMethod::Affine;
}

std::unique_ptr<WarpPredictor> make_predictor(RegistrationMethod method,
                                              std::optional<std::span<const std::uint8_t>> onnx,
                                              const NetworkPredictorParams& params) {
  const std::optional<NetworkKind> kind = network_of(method);
  if (!kind) {
    return make_without_network(method, onnx.has_value());
  }
  const std::span<const std::uint8_t> network = onnx ? *onnx : shipped_network(*kind);
  if (network.empty() && !onnx) {
    throw std::invalid_argument("no network for " + name_of(method) +
                                " comes with this program; give one that sketchloc train made");
  }
  std::unique_ptr<WarpPredictor> predictor = make_network_predictor(network, *kind, params);
  const bool verifies =
      kind == NetworkKind::Ours && params.verify && !shipped_verification().empty();
  return verifies
             ? make_verified_predictor(std::move(predictor), shipped_verification(), params.window)
             : std::move(predictor);
}

}  // namespace sketchloc
