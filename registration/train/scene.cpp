#include "registration/train/scene.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "datasets/sim/building.hpp"
#include "datasets/sim/plan_generators.hpp"
#include "motion/angles.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

constexpr int kAttempts = 20;
constexpr double kMargin_m = 0.5;        ///< of the tables around the building
constexpr double kWall_m = 0.2;          ///< rooms reach this far into their walls
constexpr double kIndoorsCell_m = 0.25;  ///< of the map of what is inside

BuildingKind draw_kind(const SceneParams& params, Rng& rng) {
  const double share = uniform(rng);
  if (share < params.home_share) {
    return BuildingKind::Home;
  }
  return share < params.home_share + params.office_share ? BuildingKind::Office
                                                         : BuildingKind::Warehouse;
}

Grid<std::uint8_t> indoor_cells(const FloorPlan& plan, const PlaneBox& box) {
  const Eigen::Vector2d size = box.size() / kIndoorsCell_m;
  Grid<std::uint8_t> cells(static_cast<int>(std::ceil(size.x())),
                           static_cast<int>(std::ceil(size.y())));
  for (int row = 0; row < cells.height(); ++row) {
    for (int column = 0; column < cells.width(); ++column) {
      const Eigen::Vector2d point = box.low + kIndoorsCell_m * centre_of({column, row});
      for (const Room& room : plan.rooms) {
        if (room.box_in_world.grown(kWall_m).contains(point)) {
          cells.at({column, row}) = 1;
        }
      }
    }
  }
  return cells;
}

}  // namespace

LidarModel draw_lidar(const SceneParams& params, Rng& rng) {
  const double view_rad = uniform(params.min_field_of_view_rad, params.max_field_of_view_rad, rng);
  return {.field_of_view_rad = view_rad,
          .beams = static_cast<int>(deg_from_rad(view_rad)) + 1,
          .max_range_m = uniform(params.min_max_range_m, params.max_max_range_m, rng),
          .range_sigma_m = uniform(0.005, 0.03, rng),
          .dropout_share = uniform(0.0, 0.03, rng),
          .short_share = uniform(0.0, 0.02, rng),
          .forward_m = uniform(-0.1, 0.25, rng)};
}

std::vector<Scan> scan_drive(const LidarSimulator& lidar, const MetricTrajectory& drive, Rng& rng) {
  std::vector<Scan> scans;
  scans.reserve(drive.size());
  for (const Stamped<Se2>& pose : drive) {
    scans.push_back(lidar.scan(pose.pose, pose.time_s, rng));
  }
  return scans;
}

void validate(const SceneParams& params) {
  require_in_range("human_share", params.human_share, 0.0, 1.0);
  require_in_range("home_share", params.home_share, 0.0, 1.0);
  require_in_range("office_share", params.office_share, 0.0, 1.0 - params.home_share);
  require_above("drive_m", params.drive_m, 0.0);
  require_in_range("min_field_of_view_rad", params.min_field_of_view_rad, 0.1,
                   2.0 * std::numbers::pi);
  require_in_range("max_field_of_view_rad", params.max_field_of_view_rad,
                   params.min_field_of_view_rad, 2.0 * std::numbers::pi);
  require_above("min_max_range_m", params.min_max_range_m, 0.0);
  require_at_least("max_max_range_m", params.max_max_range_m, params.min_max_range_m);
}

/// The parts of a scene before they are made ready.
struct Scene::Made {
  Building building;
  Drawing drawing;
  MetricTrajectory drive;
  LidarModel lidar;
};

Scene::Made Scene::make(const SceneParams& params, Rng& rng) {
  const BuildingKind kind = draw_kind(params, rng);
  const PersonParams person = uniform(rng) < params.human_share ? human_person() : tps_person();
  const LidarModel lidar = draw_lidar(params, rng);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    Building building = building_from_plan(make_plan(kind, rng));
    Drive drive = drive_through(building, {.length_m = params.drive_m}, rng);
    if (drive.status == Drive::Status::Driven) {
      Drawing drawing = draw(building.plan, person, rng);
      return {.building = std::move(building),
              .drawing = std::move(drawing),
              .drive = std::move(drive.world_from_robot),
              .lidar = lidar};
    }
  }
  throw std::runtime_error("no building was found that the robot can drive through");
}

Scene::Scene(const SceneParams& params, Rng& rng) : Scene(make(params, rng), rng) {}

Scene::Scene(Made made, Rng& rng)
    : sketch_(made.drawing.sketch.occupied),
      sketch_from_world_(std::move(made.drawing.sketch_from_world),
                         bounds_in_world(made.building.plan).grown(kMargin_m)),
      drive_(std::move(made.drive)),
      lidar_(made.building.map, made.lidar),
      scans_(scan_drive(lidar_, drive_, rng)),
      origin_in_world_(bounds_in_world(made.building.plan).grown(kMargin_m).low),
      indoors_(
          indoor_cells(made.building.plan, bounds_in_world(made.building.plan).grown(kMargin_m))) {}

bool Scene::indoors(const Eigen::Vector2d& point_in_world) const {
  const Cell cell = cell_at((point_in_world - origin_in_world_) / kIndoorsCell_m);
  return indoors_.contains(cell) && indoors_.at(cell) != 0;
}

}  // namespace sketchloc
