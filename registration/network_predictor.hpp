#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "registration/local_window.hpp"
#include "registration/network_kind.hpp"
#include "registration/warp_predictor.hpp"

namespace sketchloc {

struct NetworkPredictorParams {
  LocalWindow window;        ///< of the first look: the one that the network was trained with
  int looks = 2;             ///< ours: how often it looks, from its own last result, >= 1
  double fine_side_m = 7.0;  ///< ours: side of the window of all looks but the first, > 0
  bool verify = true;        ///< ours: see make_verified_predictor
};

template <typename Visitor>
void visit_fields(NetworkPredictorParams& params, Visitor&& visit) {
  visit("window", params.window);
  visit("looks", params.looks);
  visit("fine_side_m", params.fine_side_m);
  visit("verify", params.verify);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const NetworkPredictorParams& params);

/// Networks as small as these run faster on one thread than on several; of the whole process.
void run_networks_on_one_thread();

/// A network, given as the bytes of an ONNX file, as a predictor; all priors go through it in one
/// batch. Not safe to share between threads. Throws std::runtime_error where the bytes are no
/// network of that kind.
std::unique_ptr<WarpPredictor> make_network_predictor(std::span<const std::uint8_t> onnx,
                                                      NetworkKind kind,
                                                      const NetworkPredictorParams& params = {});

}  // namespace sketchloc
