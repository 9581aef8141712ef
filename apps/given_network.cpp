#include "apps/given_network.hpp"

#include <spdlog/spdlog.h>

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>

#include "apps/option_checks.hpp"
#include "apps/read_bytes.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

std::string read_network(const fs::path& file) {
  const std::optional<std::string> bytes = read_bytes(file);
  if (!bytes || bytes->empty()) {
    throw std::runtime_error(file.string() +
                             ": cannot be read or is empty; give the network.onnx of sketchloc "
                             "train");
  }
  return *bytes;
}

}  // namespace

const std::map<std::string, RegistrationMethod>& registration_methods() {
  static const auto names = names_of(RegistrationMethod{});
  static const std::map<std::string, RegistrationMethod> methods(names.begin(), names.end());
  return methods;
}

std::unique_ptr<WarpPredictor> predictor_from(RegistrationMethod kind, const fs::path& network,
                                              const NetworkPredictorParams& params) {
  if (network.empty()) {
    try {
      return make_predictor(kind, std::nullopt, params);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(std::string(error.what()) + ", by --network FILE.onnx");
    }
  }
  const std::string method = name_of(registration_methods(), kind);
  if (!network_of(kind)) {
    throw std::invalid_argument("--method " + method + " runs no network; leave out --network");
  }
  const std::string onnx = read_network(network);
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(onnx.data()), onnx.size());
  try {
    return make_predictor(kind, bytes, params);
  } catch (const std::runtime_error& error) {
    spdlog::debug("{}", error.what());
    throw std::runtime_error(network.string() + ": is no network for --method " + method +
                             "; give the network.onnx of sketchloc train --network " + method);
  }
}

}  // namespace sketchloc
