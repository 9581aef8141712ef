#include "apps/given_network.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

std::string name_of(RegistrationMethod method) {
  const auto names = names_of(method);
  return std::string(
      std::ranges::find(names, method, [](const auto& named) { return named.second; })->first);
}

std::vector<std::uint8_t> read_network(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<std::uint8_t> bytes;
  if (stream && fs::is_regular_file(file)) {
    bytes.assign(std::istreambuf_iterator<char>(stream), {});
  }
  if (bytes.empty()) {
    throw std::runtime_error(file.string() +
                             ": cannot be read or is empty; give the network.onnx of sketchloc "
                             "train");
  }
  return bytes;
}

}  // namespace

std::unique_ptr<WarpPredictor> predictor_from(RegistrationMethod kind, const fs::path& network,
                                              const NetworkPredictorParams& params) {
  if (network.empty()) {
    try {
      return make_predictor(kind, std::nullopt, params);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(std::string(error.what()) + ", by --network FILE.onnx");
    }
  }
  const std::string method = name_of(kind);
  if (!network_of(kind)) {
    throw std::invalid_argument("--method " + method + " runs no network; leave out --network");
  }
  const std::vector<std::uint8_t> onnx = read_network(network);
  try {
    return make_predictor(kind, onnx, params);
  } catch (const std::runtime_error& error) {
    spdlog::debug("{}", error.what());
    throw std::runtime_error(network.string() + ": is no network for --method " + method +
                             "; give the network.onnx of sketchloc train --network " + method);
  }
}

}  // namespace sketchloc
