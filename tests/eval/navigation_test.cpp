#include "eval/navigation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "eval/navigation_picture.hpp"
#include "eval/navigation_record.hpp"
#include "eval/navigation_summary.hpp"

namespace sketchloc {
namespace {

NavigationTrial trial(NavigationTrial::End end, double error_m, double way_m) {
  NavigationTrial one{.set = "human 0", .kind = "human", .method = "mcl", .end = end};
  one.error_m = error_m;
  one.nearest_m = error_m;
  one.way_m = way_m;
  one.shortest_m = 8.0;
  one.cycle_ms = {1.0, 3.0};
  one.cycle_processor_ms = {1.0, 2.0};
  return one;
}

TEST(Navigation, CountsArrivalsNearTheTrueGoalAlone) {
  const std::vector<NavigationTrial> trials = {trial(NavigationTrial::End::Arrived, 0.1, 10.0),
                                               trial(NavigationTrial::End::Arrived, 0.3, 10.0),
                                               trial(NavigationTrial::End::Stuck, 0.1, 10.0),
                                               trial(NavigationTrial::End::Arrived, 0.1, 8.0)};
  const auto row = nlohmann::json::parse(navigation_suite_json(trials, 0.2))["rows"][0];
  EXPECT_EQ(row["trials"], 4);
  EXPECT_EQ(row["successes"], 2);
  EXPECT_EQ(row["within_bound_on_the_way"], 3);
  EXPECT_NEAR(row["spl"], (0.8 + 1.0) / 4.0, 1e-12);
  EXPECT_NEAR(row["error_median_m"], 0.1, 1e-12);
  EXPECT_THAT(navigation_suite_markdown(trials, 0.2), ::testing::HasSubstr("2/4 = 50 %"));
}

TEST(Navigation, ReadsWhatItWrote) {
  const NavigationTrial written = trial(NavigationTrial::End::Stuck, 0.7, 9.0);
  const NavigationTrial read = navigation_from_json(navigation_json(written));
  EXPECT_EQ(read.end, written.end);
  EXPECT_EQ(read.error_m, written.error_m);
  EXPECT_EQ(read.cycle_ms, written.cycle_ms);
  EXPECT_THROW(navigation_from_json("{}"), std::runtime_error);
}

TEST(Navigation, DrivesWithoutCollisionAndTheSameForTheSameSeed) {
  NavigationParams params;
  params.most_cycles = 25;
  const NavigationTask task =
      navigation_task("human", 0, params.task, params.follower.body.radius_m, 500);
  EXPECT_GE(task.shortest_m, params.task.least_way_m);
  const auto drive = [&] {
    const LocalizationParams filter;
    const auto no_time = [] { return 0.0; };
    return navigate(task, {.method = localization_method("mcl"), .localization = filter}, params, 3,
                    {.wall_s = no_time, .processor_s = no_time});
  };
  const NavigationTrial once = drive();
  const NavigationTrial again = drive();
  EXPECT_GT(once.way_m, 1.0);
  EXPECT_EQ(once.collisions, 0);
  EXPECT_EQ(navigation_json(once), navigation_json(again));
  EXPECT_THAT(picture_png(task, once), ::testing::HasSubstr("PNG"));
}

}  // namespace
}  // namespace sketchloc
