#include "registration/verified_predictor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "registration/network_predictor.hpp"
#include "registration/shipped_networks.hpp"
#include "registration/train/driven_submap.hpp"
#include "registration/train/scene.hpp"
#include "tests/support/similarity_registration.hpp"

namespace sketchloc {
namespace {

/// Finds every prior right, but for the first.
class AllButTheFirst final : public WarpPredictor {
 public:
  std::vector<std::optional<Registration>> predict(std::span<const PlacedScan>,
                                                   const SketchCropper&,
                                                   std::span<const Sim2> priors) override {
    std::vector<std::optional<Registration>> found(priors.size());
    for (std::size_t i = 1; i < priors.size(); ++i) {
      found[i] = testing::similarity_registration(priors[i]);
    }
    return found;
  }
};

TEST(VerifiedPredictor, TellsTheRobotsPlaceFromOthersInDrawingsByPeople) {
  if (shipped_verification().empty()) {
    GTEST_SKIP() << "no verification network comes with this program";
  }
  const auto predictor =
      make_verified_predictor(std::make_unique<AllButTheFirst>(), shipped_verification());
  int likelier = 0;
  int asked = 0;
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Rng rng = make_rng(seed, 77);
    const Scene scene({.human_share = 1.0, .drive_m = 20.0}, rng);
    const auto pose_at = [&](const Se2& world_from_robot) {
      return scene.sketch_from_world().exact().sketch_from_robot(world_from_robot);
    };
    for (std::size_t present = 5; present < scene.drive().size(); present += 5) {
      const std::vector<PlacedScan> submap =
          draw_driven_submap(scene.drive(), scene.scans(), present, {}, rng);
      const Se2& here = scene.drive()[present].pose;
      const Se2& there = scene.drive()[draw_index(scene.drive().size(), rng)].pose;
      const Se2 turned =
          Se2::from_xy_yaw(there.x_m(), there.y_m(), there.yaw_rad() + 0.5 * std::numbers::pi);
      const std::vector<Sim2> priors = {pose_at(here), pose_at(here), pose_at(turned)};
      const auto found = predictor->predict(submap, scene.sketch(), priors);
      ASSERT_EQ(found.size(), 3U);
      EXPECT_FALSE(found[0].has_value());
      if (std::abs((here.inverse() * turned).yaw_rad()) > kVerified_rad) {
        likelier += *found[1]->place_log_odds > *found[2]->place_log_odds ? 1 : 0;
        ++asked;
      }
    }
  }
  ASSERT_GT(asked, 20);
  EXPECT_GT(likelier, 0.8 * asked);
}

TEST(VerifiedPredictor, RefusesOtherNetworks) {
  const std::vector<std::uint8_t> noise(100, 7);
  EXPECT_THROW(make_verified_predictor(std::make_unique<AllButTheFirst>(), noise),
               std::runtime_error);
  EXPECT_THROW(make_verified_predictor(std::make_unique<AllButTheFirst>(),
                                       shipped_network(NetworkKind::Ours)),
               std::runtime_error);
}

}  // namespace
}  // namespace sketchloc
