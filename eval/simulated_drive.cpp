#include "eval/simulated_drive.hpp"

#include <numbers>
#include <stdexcept>
#include <utility>

#include "datasets/sim/building.hpp"
#include "datasets/sim/plan_generators.hpp"
#include "motion/random.hpp"

namespace sketchloc {
namespace {

constexpr std::uint64_t kAttempts = 20;

}  // namespace

LidarModel lidar_of(const DriveName& name) {
  LidarModel lidar;
  if (name.plan % 2 == 1) {
    lidar.field_of_view_rad = 2.0 * std::numbers::pi;
    lidar.beams = 361;
  }
  return lidar;
}

DataSet simulated_drive(const DriveName& name, DataSetParams params, std::uint64_t seed) {
  constexpr BuildingKind kKinds[] = {BuildingKind::Home, BuildingKind::Office,
                                     BuildingKind::Warehouse};
  params.lidar = lidar_of(name);
  for (std::uint64_t attempt = 0; attempt < kAttempts; ++attempt) {
    Rng rng = make_rng(seed, name.suite + static_cast<std::uint64_t>(name.plan), attempt);
    const Building building = building_from_plan(make_plan(kKinds[name.plan % 3], rng));
    Rng drawing_rng = make_rng(rng(), static_cast<std::uint64_t>(name.drawing));
    DataSetInBuilding made = generate_data_set(building, params, drawing_rng());
    if (made.status == DataSetInBuilding::Status::Made) {
      return *std::move(made.data_set);
    }
  }
  throw std::runtime_error("no building was found that the robot can drive through");
}

}  // namespace sketchloc
