#include "registration/train/place_samples.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

#include "datasets/sim/building.hpp"
#include "datasets/sim/place_labels.hpp"
#include "datasets/sim/plan_generators.hpp"
#include "motion/validate.hpp"
#include "registration/train/driven_submap.hpp"

namespace sketchloc {
namespace {

constexpr int kAttempts = 20;

/// What a robot would see in the mirror: buildings have no handedness.
void mirror(std::vector<float>& planes, int cells) {
  const auto side = static_cast<std::ptrdiff_t>(cells);
  for (auto plane = planes.begin(); plane != planes.end(); plane += side * side) {
    for (std::ptrdiff_t row = 0; row < side / 2; ++row) {
      const auto right = plane + row * side;
      std::swap_ranges(right, right + side, plane + (side - 1 - row) * side);
    }
  }
}

}  // namespace

/// A drive through a building by somebody who knows what kinds of places there are.
struct PlaceSamples::LabelledDrive {
  MetricTrajectory world_from_robot;
  std::vector<Scan> scans;
  std::vector<PlaceLabel> labels;
};

struct PlaceSamples::Slot {
  std::optional<LabelledDrive> drive;
  std::uint64_t generation = 0;
};

void validate(const PlaceSampleParams& params) {
  validate(params.scene);
  require_in_range("office_share", params.office_share, 0.0, 1.0);
  validate(params.look);
  validate(params.submap_noise);
  require_at_least("scenes", params.scenes, 1.0);
  require_at_least("samples_per_scene", params.samples_per_scene, 1.0);
  require_at_least("batch", params.batch, 1.0);
}

PlaceSamples::PlaceSamples(const PlaceSampleParams& params, SampleSplit split, std::uint64_t seed)
    : params_((validate(params), params)),
      drive_seed_(split_seed(split, seed, 3)),  // others have 0, 1 and 2
      sample_seed_(split_seed(split, seed, 4)),
      slots_(static_cast<std::size_t>(params.scenes)) {}

PlaceSamples::~PlaceSamples() = default;

/// Drives change one after the other, not all in the same batch.
const PlaceSamples::LabelledDrive& PlaceSamples::drive_for(std::size_t slot, std::uint64_t sample) {
  const std::uint64_t scenes = slots_.size();
  const auto life = static_cast<std::uint64_t>(params_.samples_per_scene);
  const std::uint64_t generation = (sample / scenes + slot * life / scenes) / life;
  Slot& here = slots_[slot];
  if (here.drive && here.generation == generation) {
    return *here.drive;
  }
  Rng rng = make_rng(drive_seed_, slot, generation);
  const BuildingKind kind =
      uniform(rng) < params_.office_share ? BuildingKind::Office : BuildingKind::Warehouse;
  const LidarModel lidar = draw_lidar(params_.scene, rng);
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    const Building building = building_from_plan(make_plan(kind, rng));
    Drive drive = drive_through(building, {.length_m = params_.scene.drive_m}, rng);
    if (drive.status == Drive::Status::Driven) {
      MetricTrajectory& poses = drive.world_from_robot;
      here.generation = generation;
      here.drive.emplace(
          LabelledDrive{.world_from_robot = {},
                        .scans = scan_drive(LidarSimulator(building.map, lidar), poses, rng),
                        .labels = PlaceLabeller(building.plan).labels(poses)});
      here.drive->world_from_robot = std::move(poses);
      return *here.drive;
    }
  }
  throw std::runtime_error("no building was found that the robot can drive through");
}

PlaceBatch PlaceSamples::batch(std::uint64_t number) {
  const DrivenSubmapParams submap{.min_scans = params_.look.scans.max_scans,
                                  .max_scans = params_.look.scans.max_scans,
                                  .scan_spacing_m = params_.look.scans.spacing_m,
                                  .noise = params_.submap_noise};
  PlaceBatch batch{.count = params_.batch};
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(params_.batch); ++i) {
    const std::uint64_t sample = number * static_cast<std::uint64_t>(params_.batch) + i;
    const LabelledDrive& drive = drive_for(sample % slots_.size(), sample);
    Rng rng = make_rng(sample_seed_, sample);
    const std::size_t present = draw_index(drive.scans.size(), rng);
    std::vector<float> planes =
        place_input(draw_driven_submap(drive.world_from_robot, drive.scans, present, submap, rng),
                    params_.look.window);
    if (uniform(rng) < 0.5) {
      mirror(planes, params_.look.window.cells);
    }
    batch.input.insert(batch.input.end(), planes.begin(), planes.end());
    batch.answer.push_back(static_cast<std::int64_t>(drive.labels[present]));
  }
  return batch;
}

}  // namespace sketchloc
