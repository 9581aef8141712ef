#include "topology/place_classifier.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

#include "datasets/sim/drive.hpp"
#include "datasets/sim/lidar_model.hpp"
#include "datasets/sim/place_labels.hpp"
#include "datasets/sim/plan_generators.hpp"
#include "registration/shipped_networks.hpp"

namespace sketchloc {
namespace {

/// A drive through a warehouse and what kinds of places it passes.
struct LabelledDrive {
  std::vector<Se2> world_from_robot;
  std::vector<Scan> scans = {};
  std::vector<PlaceLabel> labels;
};

LabelledDrive drive_through_warehouse(std::uint64_t seed) {
  Rng rng = make_rng(seed);
  const Building building = building_from_plan(make_warehouse(rng));
  const Drive drive = drive_through(building, {.length_m = 120.0}, rng);
  const LidarSimulator lidar(building.map, {});
  LabelledDrive labelled{.world_from_robot = poses_of(drive.world_from_robot),
                         .labels = PlaceLabeller(building.plan).labels(drive.world_from_robot)};
  for (const Se2& pose : labelled.world_from_robot) {
    labelled.scans.push_back(lidar.scan(pose, 0.0, rng));
  }
  return labelled;
}

/// Three warehouses, not those that the network learned from: half the share that it is right
/// about, so that this fails where scans and network do not belong together, not by chance.
TEST(PlaceClassifier, KnowsTheKindsOfPlacesOfAWarehouse) {
  PlaceClassifier classifier(shipped_place_classifier());
  for (const std::uint64_t seed : {7001U, 7002U, 7003U}) {
    const LabelledDrive drive = drive_through_warehouse(seed);
    const std::vector<PlaceLabel> told =
        classify_places(classifier, drive.scans, drive.world_from_robot);
    ASSERT_EQ(told.size(), drive.labels.size());
    const int right = std::inner_product(told.begin(), told.end(), drive.labels.begin(), 0,
                                         std::plus<>(), std::equal_to<>());
    EXPECT_GT(right, 0.8 * static_cast<double>(told.size())) << seed;
  }
}

TEST(PlaceClassifier, StatesProbabilities) {
  PlaceClassifier classifier(shipped_place_classifier());
  const LabelledDrive drive = drive_through_warehouse(7001);
  const PlacedScan alone{.scan = &drive.scans.front()};
  const PlaceProbabilities probabilities = classifier.classify({&alone, 1});
  EXPECT_NEAR(std::accumulate(probabilities.begin(), probabilities.end(), 0.0), 1.0, 1e-9);
  EXPECT_EQ(likeliest({0.1, 0.2, 0.7}), PlaceLabel::Intersection);
}

TEST(PlaceClassifier, RefusesWhatIsNoSuchNetwork) {
  const std::array<std::uint8_t, 3> noise = {1, 2, 3};
  EXPECT_THROW(PlaceClassifier{noise}, std::runtime_error);
  EXPECT_THROW(PlaceClassifier{shipped_place_comparator()}, std::runtime_error);
  EXPECT_THROW(PlaceClassifier(shipped_place_classifier(), {.window = {.cells = 48}}),
               std::runtime_error);
  EXPECT_THROW(PlaceClassifier(shipped_place_classifier(), {.window = {.side_m = -1.0}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
