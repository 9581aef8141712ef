#include "eval/navigation_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/markup.hpp"

namespace sketchloc {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::markup_faults;
using ::testing::Not;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const NavigationParams& params() {
  static const NavigationParams params;
  return params;
}

const NavigationTask& home() {
  static const NavigationTask task =
      navigation_task("human", 0, params().task, params().follower.body.radius_m, 500);
  return task;
}

/// A robot that goes straight on through the middle of the drawing.
NavigationTrial drive_of(int frames) {
  NavigationTrial trial{.set = "human 0", .kind = "human", .method = "<mcl>"};
  trial.paths_in_sketch = {{{10.0, 10.0}, {90.0, 50.0}}};
  for (int i = 0; i < frames; ++i) {
    trial.frames.push_back({.world_from_robot = Se2::from_xy_yaw(0.2 * i, 1.0, 0.0),
                            .sketch_from_robot = Sim2::from_xy_yaw_scale(4.0 * i, 20.0, 0.0, 20.0),
                            .position_covariance_px2 = Eigen::Matrix2d::Identity(),
                            .seen_in_robot = {{1.0, 2.0}, {3.0, -0.5}}});
  }
  return trial;
}

nlohmann::json data_of(const std::string& page) {
  const std::string opening = "type=\"application/json\">";
  const std::size_t begin = page.find(opening) + opening.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(NavigationPage, IsWellFormedAndLoadsNothing) {
  const std::string page = drive_html(home(), drive_of(3), params());
  EXPECT_THAT(markup_faults(page), IsEmpty());
  EXPECT_THAT(page, Not(HasSubstr("http:")));
  EXPECT_THAT(page, Not(HasSubstr("https:")));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, HasSubstr("&lt;mcl&gt;"));
}

TEST(NavigationPage, ShowsTheWholeDriveBeforeTheScriptedPart) {
  const std::string page = drive_html(home(), drive_of(3), params());
  EXPECT_LT(page.find("<img style"), page.find("<section id=\"player\" hidden=\"hidden\">"));
}

TEST(NavigationPage, HoldsAFrameForEveryScan) {
  const nlohmann::json data = data_of(drive_html(home(), drive_of(7), params()));
  ASSERT_EQ(data["frames"].size(), 7U);
  EXPECT_EQ(data["frames"][2]["w"], nlohmann::json({0.4, 1.0, 0.0}));
  EXPECT_EQ(data["frames"][2]["s"], nlohmann::json({8.0, 20.0, 0.0, 20.0}));
  EXPECT_EQ(data["frames"][2]["e"], nlohmann::json({{1.0, 2.0}, {3.0, -0.5}}));
  EXPECT_EQ(data["paths_px"][0], nlohmann::json({{10.0, 10.0}, {90.0, 50.0}}));
}

TEST(NavigationPage, NamesEverythingThatARobotDoes) {
  const nlohmann::json data = data_of(drive_html(home(), drive_of(1), params()));
  EXPECT_EQ(data["doings"].size(), static_cast<std::size_t>(Navigator::Doing::GivesUp) + 1);
}

TEST(NavigationPage, LeavesOutNumbersThatAreNone) {
  NavigationTrial trial = drive_of(2);
  trial.frames[1].localized_probability = kNan;
  trial.frames[1].goal_in_robot = {kNan, std::numeric_limits<double>::infinity()};
  trial.frames[1].position_covariance_px2 = std::nullopt;
  const std::string page = drive_html(home(), trial, params());
  const nlohmann::json frame = data_of(page)["frames"][1];
  EXPECT_TRUE(frame["p"].is_null());
  EXPECT_EQ(frame["g"], nlohmann::json({nullptr, nullptr}));
  EXPECT_TRUE(frame["c"].is_null());
}

TEST(NavigationPage, OfADriveWithoutAScanIsStillAPage) {
  EXPECT_THAT(markup_faults(drive_html(home(), drive_of(0), params())), IsEmpty());
}

}  // namespace
}  // namespace sketchloc
