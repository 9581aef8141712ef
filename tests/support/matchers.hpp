#pragma once

#include <gmock/gmock.h>

#include "motion/angles.hpp"
#include "motion/se2.hpp"
#include "motion/sim2.hpp"

namespace sketchloc {

// gtest prints poses by these.
inline void PrintTo(const Se2& pose, std::ostream* out) {
  *out << "(" << pose.x_m() << " m, " << pose.y_m() << " m, " << deg_from_rad(pose.yaw_rad())
       << " deg)";
}
inline void PrintTo(const Sim2& pose, std::ostream* out) {
  *out << "(" << pose.x() << ", " << pose.y() << ", " << deg_from_rad(pose.yaw_rad())
       << " deg, scale " << pose.scale() << ")";
}

namespace testing {

/// Translation, heading and scale (relative) within a tolerance; prints the error.
MATCHER_P2(IsNear, expected, tolerance, "") {
  const double shift = (arg.translation() - expected.translation()).norm();
  const double turn_rad = std::abs(wrap_rad(arg.yaw_rad() - expected.yaw_rad()));
  double scale_error = 0.0;
  if constexpr (requires { arg.scale(); }) {
    scale_error = std::abs(arg.scale() / expected.scale() - 1.0);
  }
  *result_listener << "off by " << shift << ", " << turn_rad << " rad, scale " << scale_error;
  return shift <= tolerance && turn_rad <= tolerance && scale_error <= tolerance;
}

}  // namespace testing
}  // namespace sketchloc
