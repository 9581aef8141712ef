#pragma once

#include "registration/network_input.hpp"

namespace sketchloc {

/// The networks that `sketchloc train` makes: `Chen20` as published, `Affine` its sister without
/// bending, `Ours`.
enum class NetworkKind { Chen20, Affine, Ours };

constexpr InputKind input_of(NetworkKind kind) {
  return kind == NetworkKind::Ours ? InputKind::Residual : InputKind::Published;
}

}  // namespace sketchloc
