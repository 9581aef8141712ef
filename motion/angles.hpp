#pragma once

#include <numbers>

namespace sketchloc {

/// The same angle in (-pi, pi].
double wrap_rad(double angle_rad);

constexpr double rad_from_deg(double angle_deg) { return angle_deg * (std::numbers::pi / 180.0); }
constexpr double deg_from_rad(double angle_rad) { return angle_rad * (180.0 / std::numbers::pi); }

}  // namespace sketchloc
