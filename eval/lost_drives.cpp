#include "eval/lost_drives.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include "eval/simulated_drive.hpp"
#include "motion/check.hpp"
#include "motion/random.hpp"

namespace sketchloc {
namespace {

constexpr std::uint64_t kSuite = 0x105710;
constexpr std::uint64_t kCarriedStream = 0xCA221ED;
constexpr std::uint64_t kAttempts = 20;
constexpr double kCarriedM = 5.0;    ///< at least, so that it is another place
constexpr double kCarryTimeS = 1.0;  ///< what the log sees of it

FilterData data_of(DataSet made) {
  return {.sketch = std::move(made.drawing.sketch),
          .run = std::move(made.run),
          .reference = std::move(made.reference)};
}

DataSetParams drive_of(double length_m) {
  return {.person = human_person(), .drive = {.length_m = length_m}};
}

FilterData kidnapped_drive(const DriveName& name, double drive_m, std::uint64_t seed) {
  const DataSetParams params = drive_of(0.5 * drive_m);
  DataSet first = simulated_drive(name, params, seed);
  DataSetParams then = params;
  then.lidar = lidar_of(name);
  const MetricTrajectory& way = first.world_from_robot;
  const Se2 left = way[way.size() - 1].pose;
  for (std::uint64_t attempt = 0; attempt < kAttempts; ++attempt) {
    Rng rng = make_rng(seed, kCarriedStream + static_cast<std::uint64_t>(name.plan), attempt);
    DataSetInBuilding made = generate_data_set(first.building, first.drawing, then, rng());
    if (made.status != DataSetInBuilding::Status::Made) {
      continue;
    }
    const Se2 found = made.data_set->world_from_robot[0].pose;
    if ((found.translation() - left.translation()).norm() >= kCarriedM) {
      return carried(data_of(std::move(first)), data_of(*std::move(made.data_set)));
    }
  }
  throw std::runtime_error("nowhere in the building to carry the robot to");
}

FilterData drive_in_wrong_drawing(const DriveName& name, double drive_m, std::uint64_t seed) {
  const DataSetParams params = drive_of(drive_m);
  FilterData data = data_of(simulated_drive(name, params, seed));
  // The same kind of building, and a robot of another kind.
  FilterData other = data_of(simulated_drive(
      {.suite = name.suite, .plan = name.plan + 3, .drawing = name.drawing}, params, ~seed));
  data.run = std::move(other.run);
  data.start = FilterStart::WrongDrawing;
  return data;
}

FilterTask task_of(const std::string& kind, const DriveName& name,
                   const std::function<FilterData()>& make) {
  return {.set = kind + " plan " + std::to_string(name.plan + 1) + " drawing " +
                 std::to_string(name.drawing + 1),
          .kind = kind,
          .make = make};
}

}  // namespace

FilterData carried(FilterData first, const FilterData& second) {
  check(!first.run.steps.empty() && !second.run.steps.empty(), "two drives");
  const std::size_t steps = first.run.steps.size();
  const Se2 odom_from_end = first.run.steps.back().odom_from_robot;
  const Se2 start_from_odom = second.run.steps.front().odom_from_robot.inverse();
  const double shift_s =
      first.run.steps.back().scan.time_s + kCarryTimeS - second.run.steps.front().scan.time_s;
  for (RunStep step : second.run.steps) {
    step.scan.time_s += shift_s;
    step.odom_from_robot = odom_from_end * start_from_odom * step.odom_from_robot;
    first.run.steps.push_back(std::move(step));
  }
  for (ReferencePose pose : second.reference.poses) {
    pose.step += steps;
    pose.time_s += shift_s;
    first.reference.poses.push_back(pose);
  }
  first.carried_at = steps;
  return first;
}

std::vector<FilterTask> lost_drives(const FilterSuiteParams& params, std::uint64_t seed) {
  validate(params);
  std::vector<FilterTask> tasks;
  const auto add = [&](const std::string& kind, auto make) {
    for (int plan = 0; plan < params.plans; ++plan) {
      for (int drawing = 0; drawing < params.drawings; ++drawing) {
        const DriveName name{.suite = kSuite, .plan = plan, .drawing = drawing};
        tasks.push_back(task_of(kind, name, [=] { return make(name); }));
      }
    }
  };
  const double drive_m = params.drive_m;
  add("global start", [=](const DriveName& name) {
    FilterData data = data_of(simulated_drive(name, drive_of(drive_m), seed));
    data.start = FilterStart::Anywhere;
    return data;
  });
  for (FilterTask& task : tasks) {
    task.start = FilterStart::Anywhere;
  }
  add("kidnapped", [=](const DriveName& name) { return kidnapped_drive(name, drive_m, seed); });
  add("wrong drawing",
      [=](const DriveName& name) { return drive_in_wrong_drawing(name, drive_m, seed); });
  return tasks;
}

}  // namespace sketchloc
