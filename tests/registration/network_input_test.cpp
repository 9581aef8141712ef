#include "registration/network_input.hpp"

#include <gtest/gtest.h>

namespace sketchloc {
namespace {

const LocalWindow kWindow{.side_m = 4.0, .cells = 16};

Scan one_beam() {
  return {.angle_step_rad = 0.01, .max_range_m = 10.0, .robot_from_laser = {}, .ranges_m = {1.1F}};
}

SketchCropper dotted() {
  Grid<std::uint8_t> occupied(200, 200);
  occupied.at({122, 100}) = 1;
  return SketchCropper(occupied);
}

TEST(NetworkInput, HasOnePlanePerChannel) {
  const Scan scan = one_beam();
  const std::vector<PlacedScan> submap = {{.scan = &scan}};
  const Sim2 prior = Sim2::from_xy_yaw_scale(100.0, 100.0, 0.0, kPublishedPxPerM);
  for (const InputKind kind : {InputKind::Published, InputKind::Residual}) {
    EXPECT_EQ(network_input(kind, submap, dotted(), prior, kWindow).size(),
              static_cast<std::size_t>(channels_of(kind)) * 256);
  }
}

TEST(NetworkInput, TakesOnlyPositionAndPresentScanForThePublishedPair) {
  const Scan scan = one_beam();
  const Scan earlier{
      .angle_step_rad = 0.01, .max_range_m = 10.0, .robot_from_laser = {}, .ranges_m = {0.6F}};
  const std::vector<PlacedScan> alone = {{.scan = &scan}};
  const std::vector<PlacedScan> both = {{.scan = &scan}, {.scan = &earlier}};
  const Sim2 prior = Sim2::from_xy_yaw_scale(100.0, 100.0, 0.0, 20.0);
  const Sim2 turned = Sim2::from_xy_yaw_scale(100.0, 100.0, 1.0, 12.0);
  const SketchCropper sketch = dotted();
  const std::vector<float> input =
      network_input(InputKind::Published, alone, sketch, prior, kWindow);
  EXPECT_EQ(input, network_input(InputKind::Published, both, sketch, turned, kWindow));
  // 1.1 m ahead in both pictures: row 8, column 12
  EXPECT_EQ(input[8 * 16 + 12], 1.0F);
  EXPECT_EQ(input[256 + 8 * 16 + 12], 1.0F);
}

}  // namespace
}  // namespace sketchloc
