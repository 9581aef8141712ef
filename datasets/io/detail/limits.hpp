#pragma once

#include <cstdint>

namespace sketchloc::detail {

// Larger values are not of this world but of a broken file (or of another unit); they would turn
// into infinities when poses are composed.
inline constexpr double kMostPosition_m = 1e9;
inline constexpr double kMostPosition_px = 1e6;
inline constexpr double kMostAngle_rad = 1e6;      ///< some logs count turns
inline constexpr double kMostBeamAngle_rad = 7.0;  ///< a full turn and a bit
inline constexpr double kMostTime_s = 1e11;        ///< seconds since 1970 until the year 5138
inline constexpr double kMostRange_m = 1e6;
inline constexpr std::int64_t kMostReadings = 100'000;  ///< of one scan

}  // namespace sketchloc::detail
