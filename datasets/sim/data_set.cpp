#include "datasets/sim/data_set.hpp"

#include <stdexcept>
#include <utility>

namespace sketchloc {
namespace {

/// Each part draws from an engine of its own, so that changing one leaves the others as they were.
enum Part : std::uint64_t { kPlan, kDrawing, kDrive, kLidar, kOdometry };

constexpr std::uint64_t kAttempts = 20;

Run measure(const Building& building, const MetricTrajectory& world_from_robot,
            const DataSetParams& params, std::uint64_t seed) {
  const LidarSimulator lidar(building.map, params.lidar);
  Rng odometry_rng = make_rng(seed, kOdometry);
  const OdometrySimulator odometry(params.odometry, odometry_rng);
  Run run;
  Se2 odom_from_robot;
  for (std::size_t step = 0; step < world_from_robot.size(); ++step) {
    if (params.checkpoint) {
      params.checkpoint();
    }
    if (step > 0) {
      const Se2 robot_from_next =
          world_from_robot[step - 1].pose.inverse() * world_from_robot[step].pose;
      odom_from_robot = odom_from_robot * odometry.measured(robot_from_next, odometry_rng);
    }
    Rng lidar_rng = make_rng(seed, kLidar, step);
    const Stamped<Se2>& truth = world_from_robot[step];
    run.steps.push_back({.scan = lidar.scan(truth.pose, truth.time_s, lidar_rng),
                         .odom_from_robot = odom_from_robot});
  }
  return run;
}

Reference true_reference(const Drawing& drawing, const MetricTrajectory& world_from_robot) {
  Reference reference;
  for (std::size_t step = 0; step < world_from_robot.size(); ++step) {
    const Stamped<Se2>& truth = world_from_robot[step];
    const Sim2 sketch_from_robot = drawing.sketch_from_world.sketch_from_robot(truth.pose);
    reference.poses.push_back(
        {.step = step,
         .time_s = truth.time_s,
         .sketch_from_robot = sketch_from_robot,
         .scored = drawing.sketch.occupied.contains(cell_at(sketch_from_robot.translation()))});
  }
  return reference;
}

Drawing make_drawing(const Building& building, const DataSetParams& params, std::uint64_t seed) {
  if (!params.person) {
    return true_map(building);
  }
  Rng rng = make_rng(seed, kDrawing);
  return draw(building.plan, *params.person, rng);
}

Drive drive_in(const Building& building, const DataSetParams& params, std::uint64_t seed) {
  Rng rng = make_rng(seed, kDrive);
  return drive_through(building, params.drive, rng, params.checkpoint);
}

DataSetInBuilding::Status status_of(Drive::Status status) {
  switch (status) {
    case Drive::Status::Driven:
      return DataSetInBuilding::Status::Made;
    case Drive::Status::NoFreeSpace:
      return DataSetInBuilding::Status::NoFreeSpace;
    case Drive::Status::NoWay:
    case Drive::Status::Confined:
      return DataSetInBuilding::Status::Confined;
  }
  return DataSetInBuilding::Status::NoFreeSpace;
}

/// What the robot measures on a drive, with the truth in the drawing.
DataSetInBuilding measured(const Building& building, Drawing drawing, Drive drive,
                           const DataSetParams& params, std::uint64_t seed) {
  if (drive.status != Drive::Status::Driven) {
    return {.status = status_of(drive.status)};
  }
  if (drawing.status == Drawing::Status::NothingToDraw) {
    return {.status = DataSetInBuilding::Status::NothingToDraw};
  }
  Run run = measure(building, drive.world_from_robot, params, seed);
  Reference reference = true_reference(drawing, drive.world_from_robot);
  return {.status = DataSetInBuilding::Status::Made,
          .data_set = DataSet{.building = building,
                              .drawing = std::move(drawing),
                              .world_from_robot = std::move(drive.world_from_robot),
                              .run = std::move(run),
                              .reference = std::move(reference)}};
}

}  // namespace

void validate(const DataSetParams& params) {
  if (params.person) {
    validate(*params.person);
  }
  validate(params.drive);
  validate(params.lidar);
  validate(params.odometry);
}

DataSetInBuilding generate_data_set(const Building& building, const DataSetParams& params,
                                    std::uint64_t seed) {
  validate(params);
  Drive drive = drive_in(building, params, seed);
  if (drive.status != Drive::Status::Driven) {  // a building without rooms cannot be drawn either
    return {.status = status_of(drive.status)};
  }
  return measured(building, make_drawing(building, params, seed), std::move(drive), params, seed);
}

DataSetInBuilding generate_data_set(const Building& building, Drawing drawing,
                                    const DataSetParams& params, std::uint64_t seed) {
  validate(params);
  return measured(building, std::move(drawing), drive_in(building, params, seed), params, seed);
}

DataSet generate_data_set(const DataSetParams& params, std::uint64_t seed) {
  for (std::uint64_t attempt = 0; attempt < kAttempts; ++attempt) {
    Rng plan_rng = make_rng(seed, kPlan, attempt);
    const Building building = building_from_plan(make_plan(params.building, plan_rng));
    DataSetInBuilding made = generate_data_set(building, params, seed);
    if (made.status == DataSetInBuilding::Status::NothingToDraw) {
      throw std::runtime_error("the person leaves out every line; " +
                               std::string("make person.pen.left_out_share smaller"));
    }
    if (made.data_set) {
      return *std::move(made.data_set);
    }
  }
  throw std::runtime_error("no building was found that the robot can drive through; " +
                           std::string("make drive.robot_radius_m smaller"));
}

}  // namespace sketchloc
