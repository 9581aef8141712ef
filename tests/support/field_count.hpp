#pragma once

#include <cstddef>
#include <utility>

namespace sketchloc::testing {

/// Becomes whatever a field wants to be initialised with; for field_count only.
struct AnyField {
  template <typename T>
  operator T() const;
};

template <typename T, std::size_t... I>
constexpr bool takes_fields(std::index_sequence<I...>) {
  return requires { T{(static_cast<void>(I), AnyField{})...}; };
}

/// Number of fields of an aggregate without arrays, found by trying ever more initialisers.
template <typename T, std::size_t kAtLeast = 0>
constexpr std::size_t field_count() {
  if constexpr (takes_fields<T>(std::make_index_sequence<kAtLeast + 1>{})) {
    return field_count<T, kAtLeast + 1>();
  } else {
    return kAtLeast;
  }
}

}  // namespace sketchloc::testing
