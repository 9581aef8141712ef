#pragma once

#include <cstdint>

#include "datasets/sim/data_set.hpp"

namespace sketchloc {

/// Which of a suite's drives is meant.
struct DriveName {
  std::uint64_t suite = 0;  ///< suites of different numbers have different buildings
  int plan = 0;
  int drawing = 0;  ///< of that plan; each has a drive of its own
};

/// The robot's scanner in a drive: every other one sees all around.
LidarModel lidar_of(const DriveName& name);

/// A drive in a building made for a suite, by turns a home, an office and a warehouse; every other
/// robot sees all around. `params` says who draws and how the robot drives and errs; its scanner
/// and kind of building are not used. Throws std::runtime_error where no building is found that
/// the robot can drive through.
DataSet simulated_drive(const DriveName& name, DataSetParams params, std::uint64_t seed);

}  // namespace sketchloc
