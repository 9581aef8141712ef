#include "registration/shipped_networks.hpp"

#include "motion/check.hpp"

// Puts the bytes of a file between two symbols.
#define SKETCHLOC_EMBED(name)                               \
  asm(".section .rodata\n"                                  \
      ".balign 16\n"                                        \
      ".global sketchloc_" #name                            \
      "_begin\n"                                            \
      "sketchloc_" #name                                    \
      "_begin:\n"                                           \
      ".incbin \"" SKETCHLOC_NETWORKS "/" #name             \
      ".onnx\"\n"                                           \
      ".global sketchloc_" #name                            \
      "_end\n"                                              \
      "sketchloc_" #name                                    \
      "_end:\n"                                             \
      ".previous\n");                                       \
  extern "C" const std::uint8_t sketchloc_##name##_begin[]; \
  extern "C" const std::uint8_t sketchloc_##name##_end[]

#ifdef SKETCHLOC_HAS_ours
SKETCHLOC_EMBED(ours);
#endif
#ifdef SKETCHLOC_HAS_chen20
SKETCHLOC_EMBED(chen20);
#endif
#ifdef SKETCHLOC_HAS_affine
SKETCHLOC_EMBED(affine);
#endif
#ifdef SKETCHLOC_HAS_verify
SKETCHLOC_EMBED(verify);
#endif
#ifdef SKETCHLOC_HAS_places
SKETCHLOC_EMBED(places);
#endif
#ifdef SKETCHLOC_HAS_same_place
SKETCHLOC_EMBED(same_place);
#endif

namespace sketchloc {

std::span<const std::uint8_t> shipped_network(NetworkKind kind) {
  switch (kind) {
    case NetworkKind::Chen20:
#ifdef SKETCHLOC_HAS_chen20
      return {sketchloc_chen20_begin, sketchloc_chen20_end};
#else
      return {};
#endif
    case NetworkKind::Affine:
#ifdef SKETCHLOC_HAS_affine
      return {sketchloc_affine_begin, sketchloc_affine_end};
#else
      return {};
#endif
    case NetworkKind::Ours:
#ifdef SKETCHLOC_HAS_ours
      return {sketchloc_ours_begin, sketchloc_ours_end};
#else
      return {};
#endif
  }
  check(false, "a kind of predictor");
  return {};
}

std::span<const std::uint8_t> shipped_verification() {
#ifdef SKETCHLOC_HAS_verify
  return {sketchloc_verify_begin, sketchloc_verify_end};
#else
  return {};
#endif
}

std::span<const std::uint8_t> shipped_place_classifier() {
#ifdef SKETCHLOC_HAS_places
  return {sketchloc_places_begin, sketchloc_places_end};
#else
  return {};
#endif
}

std::span<const std::uint8_t> shipped_place_comparator() {
#ifdef SKETCHLOC_HAS_same_place
  return {sketchloc_same_place_begin, sketchloc_same_place_end};
#else
  return {};
#endif
}

}  // namespace sketchloc
