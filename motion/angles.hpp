#pragma once

#include <cmath>
#include <numbers>

namespace sketchloc {

/// The same angle in (-pi, pi].
double wrap_rad(double angle_rad);

/// The same for the loops over particles.
inline float wrap_rad(float angle_rad) {
  constexpr float kPi = std::numbers::pi_v<float>;
  const float wrapped = angle_rad - 2.0F * kPi * std::nearbyint(angle_rad / (2.0F * kPi));
  return wrapped <= -kPi ? kPi : wrapped;
}

constexpr double rad_from_deg(double angle_deg) { return angle_deg * (std::numbers::pi / 180.0); }
constexpr double deg_from_rad(double angle_rad) { return angle_rad * (180.0 / std::numbers::pi); }

}  // namespace sketchloc
