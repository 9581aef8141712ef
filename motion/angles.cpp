#include "motion/angles.hpp"

#include <cmath>

namespace sketchloc {

double wrap_rad(double angle_rad) {
  constexpr double kPi = std::numbers::pi;
  const double wrapped = std::remainder(angle_rad, 2.0 * kPi);  // in [-pi, pi]
  return wrapped <= -kPi ? kPi : wrapped;
}

}  // namespace sketchloc
