#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "datasets/reference.hpp"
#include "datasets/run.hpp"
#include "datasets/sim/building.hpp"
#include "datasets/sim/drive.hpp"
#include "datasets/sim/lidar_model.hpp"
#include "datasets/sim/odometry_model.hpp"
#include "datasets/sim/person.hpp"
#include "datasets/sim/plan_generators.hpp"

namespace sketchloc {

struct DataSetParams {
  BuildingKind building = BuildingKind::Office;         ///< not used where a building is given
  std::optional<PersonParams> person = human_person();  ///< none: the drawing is the true map
  DriveParams drive{};
  LidarModel lidar{};
  OdometryModel odometry{};
  /// Called now and then while data sets are made; may throw to stop the work.
  std::function<void()> checkpoint = {};
};

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const DataSetParams& params);

/// A building, somebody's drawing of it, and a robot's drive through it with its truth.
struct DataSet {
  Building building;
  Drawing drawing;
  MetricTrajectory world_from_robot;  ///< true pose of every step of the run
  Run run;                            ///< what the robot measured
  Reference reference;                ///< where it truly is in the drawing, exact, every step
};

/// Everything from one seed: the same seed gives the same data set, bit for bit.
DataSet generate_data_set(const DataSetParams& params, std::uint64_t seed);

/// A data set in a given building, or why there is none.
struct DataSetInBuilding {
  enum class Status {
    Made,
    NoFreeSpace,   ///< the robot fits nowhere
    Confined,      ///< it cannot drive from place to place
    NothingToDraw  ///< the building has no lines, or the person left out all of them
  };
  Status status = Status::NoFreeSpace;
  std::optional<DataSet> data_set = {};  ///< where it was made
};

/// The same in a given building.
DataSetInBuilding generate_data_set(const Building& building, const DataSetParams& params,
                                    std::uint64_t seed);

/// The same with a drawing that somebody made of that building; params.person is not used.
DataSetInBuilding generate_data_set(const Building& building, Drawing drawing,
                                    const DataSetParams& params, std::uint64_t seed);

}  // namespace sketchloc
