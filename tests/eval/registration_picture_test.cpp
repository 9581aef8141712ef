#include "eval/registration_picture.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <vector>

#include "eval/detail/registration_scene.hpp"
#include "eval/detail/run_picture.hpp"
#include "registration/control_grid.hpp"
#include "tests/eval/synthetic_run.hpp"
#include "tests/support/markup.hpp"

namespace sketchloc {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::markup_faults;
using ::testing::Not;

/// A registration that shifts the prior by (1 m, 0.5 m) and shears the robot's plane, in the
/// drawing of a made-up run.
class RegistrationPicture : public ::testing::Test {
 protected:
  static Registration sheared(const Sim2& sketch_from_robot, double shear) {
    const LocalWindow window;
    const std::vector<Eigen::Vector2d> points =
        square_lattice(kControlsPerSide, window.side_m, window.centre_in_robot());
    std::vector<Eigen::Vector2d> places;
    for (const Eigen::Vector2d& point : points) {
      places.push_back(sketch_from_robot *
                       Eigen::Vector2d(point.x() + shear * point.y(), point.y()));
    }
    const Eigen::Vector4d variances(0.25, 1.0, 0.01, 0.01);
    return {.warp = *Warp::from_robot_points(points, places),
            .sketch_from_robot = sketch_from_robot,
            .covariance = Eigen::Matrix4d(variances.asDiagonal())};
  }

  RegistrationView view() const {
    return {.sketch = &record_.sketch,
            .submap = submap_,
            .prior_sketch_from_robot = prior_,
            .registration = &registration_};
  }

  RunRecord record_ = testing::make_synthetic_run(testing::Outcome::Located);
  std::vector<PlacedScan> submap_ = {{.scan = &record_.run.steps[5].scan}};
  Sim2 prior_ = Sim2::from_xy_yaw_scale(300.0, 275.0, 0.3, 20.0);
  Registration registration_ = sheared(prior_ * Sim2::from_xy_yaw_scale(1.0, 0.5, 0.1, 1.1), 0.3);
};

std::vector<std::string> names_in(const detail::RegistrationScene& scene) {
  std::vector<std::string> names;
  for (const detail::SceneLayer& layer : scene.samples) {
    names.push_back(layer.look.name);
  }
  return names;
}

const detail::SceneLayer& layer_of(const detail::RegistrationScene& scene,
                                   const std::string& name) {
  return *std::ranges::find_if(scene.layers, [&](const detail::SceneLayer& layer) {
    return layer.look.name.starts_with(name);
  });
}

TEST_F(RegistrationPicture, IsSmallWellFormedAndStandsAlone) {
  const std::string svg = registration_svg(view());
  EXPECT_LT(svg.size(), 60'000U);
  EXPECT_THAT(markup_faults(svg), IsEmpty());
  for (const char* foreign : {" id=", "class=", "url(", "http", "<script", "<use"}) {
    EXPECT_THAT(svg, Not(HasSubstr(foreign)));
  }
  EXPECT_TRUE(svg.starts_with("<svg ") && svg.ends_with("</svg>"));
}

TEST_F(RegistrationPicture, StaysSmallWhateverTheDrawingAndTheNumberOfScans) {
  Grid<std::uint8_t>& occupied = record_.sketch.occupied;
  for (int row = 0; row < occupied.height(); ++row) {  // what compresses worst
    for (int column = 0; column < occupied.width(); ++column) {
      occupied.at({column, row}) = (column * 7919 + row * 104'729 + column * row) % 13 < 6 ? 1 : 0;
    }
  }
  submap_.clear();
  for (const RunStep& step : record_.run.steps) {
    submap_.push_back({.scan = &step.scan});
  }
  EXPECT_LT(registration_svg(view()).size(), 60'000U);
}

TEST_F(RegistrationPicture, NamesWhatItShowsInItsLegend) {
  RegistrationView shown = view();
  EXPECT_THAT(
      names_in(detail::make_registration_scene(shown)),
      ::testing::ElementsAre(HasSubstr("squares of 2 m"), "scan at the prior", "scan, bent alike",
                             "prior", "estimate", "where it is with 95 %"));
  shown.true_sketch_from_robot = prior_;
  EXPECT_THAT(names_in(detail::make_registration_scene(shown)), ::testing::Contains("reference"));
  registration_.covariance.reset();
  EXPECT_THAT(registration_svg(shown), Not(HasSubstr("95 %")));
}

TEST_F(RegistrationPicture, ShowsThePriorAndTheScanWhereNothingWasFound) {
  RegistrationView shown = view();
  shown.registration = nullptr;
  EXPECT_THAT(names_in(detail::make_registration_scene(shown)),
              ::testing::ElementsAre("scan at the prior", "prior"));
  EXPECT_THAT(registration_svg(shown), HasSubstr("no registration found"));
  EXPECT_THAT(markup_faults(registration_svg(shown)), IsEmpty());
}

TEST_F(RegistrationPicture, BendsTheScanByTheWarp) {
  const detail::RegistrationScene scene = detail::make_registration_scene(view());
  const detail::View& square = scene.view;
  const double zoom = detail::PictureSizes::kSide / square.width();
  const Eigen::Vector2d first_in_robot = end_points_in_robot(*submap_[0].scan).front();
  const Eigen::Vector2d place =
      registration_.sketch_from_robot *
      Eigen::Vector2d(first_in_robot.x() + 0.3 * first_in_robot.y(), first_in_robot.y());
  const Eigen::Vector2d expected = zoom * (place - square.low);
  EXPECT_TRUE(layer_of(scene, "scan, bent").look.lines.front().front().isApprox(expected, 1e-6));
}

TEST_F(RegistrationPicture, DrawsTheEllipseOfTheCovarianceInTheRobotsFrame) {
  const detail::RegistrationScene scene = detail::make_registration_scene(view());
  const double zoom = detail::PictureSizes::kSide / scene.view.width();
  const Sim2& pose = registration_.sketch_from_robot;
  double ahead_m = 0.0;
  double left_m = 0.0;
  for (const Eigen::Vector2d& point : layer_of(scene, "where it is").look.lines.front()) {
    const Eigen::Vector2d in_robot =
        pose.inverse() * Eigen::Vector2d(scene.view.low + point / zoom);
    ahead_m = std::max(ahead_m, in_robot.x());
    left_m = std::max(left_m, in_robot.y());
  }
  EXPECT_NEAR(ahead_m, 0.5 * 2.4477, 0.02);  // sqrt of chi squared with 2 degrees at 95 %
  EXPECT_NEAR(left_m, 1.0 * 2.4477, 0.02);
}

TEST_F(RegistrationPicture, SaysThatAPoseFarAwayIsOutside) {
  registration_ = sheared(Sim2::from_xy_yaw_scale(1e12, -1e12, 0.0, 20.0), 0.0);
  const std::string svg = registration_svg(view());
  EXPECT_THAT(svg, HasSubstr("estimate (outside of the picture)"));
  EXPECT_LT(svg.size(), 60'000U);
  EXPECT_FALSE(registration_png(view()).empty());
}

TEST_F(RegistrationPicture, OfAPriorBesideTheSheetIsStillAPicture) {
  prior_ = Sim2::from_xy_yaw_scale(-5000.0, 275.0, 0.0, 20.0);
  registration_ = sheared(prior_, 0.0);
  EXPECT_THAT(registration_svg(view()), Not(HasSubstr("<image")));
  EXPECT_FALSE(registration_png(view()).empty());
}

TEST_F(RegistrationPicture, LeavesLinesOutWhereTheWarpHasNoValue) {
  const LocalWindow window;
  const std::vector<Eigen::Vector2d> places = square_lattice(kControlsPerSide, 320.0, {300, 275});
  std::vector<Eigen::Vector2d> points = square_lattice(kControlsPerSide, 16.0, {0, 0});
  std::swap(points.front(), points.back());  // folds
  registration_.warp = *Warp::from_sketch_places(places, points);
  EXPECT_THAT(markup_faults(registration_svg(view())), IsEmpty());
}

TEST_F(RegistrationPicture, AsAFileHasTheSameColours) {
  const std::string png = registration_png(view());
  const cv::Mat3b image = cv::imdecode(std::vector<char>(png.begin(), png.end()), cv::IMREAD_COLOR);
  EXPECT_EQ(image.cols, 960);
  EXPECT_GT(image.rows, 960);
  const auto count = [&](const detail::Colour& colour) {
    return std::count(image.begin(), image.end(), cv::Vec3b(colour.blue, colour.green, colour.red));
  };
  EXPECT_GT(count(detail::kBad), 500);
  EXPECT_GT(count(detail::kGrey), 100);
}

TEST(PaperExcerpt, IsThePartOfTheSheetThatAViewShows) {
  Sketch sketch{.occupied = Grid<std::uint8_t>(10, 6), .px_per_m = std::nullopt};
  sketch.occupied.at({9, 5}) = 1;
  const detail::PaperExcerpt corner =
      detail::paper_excerpt(sketch, {.low = {7.5, 3.2}, .high = {20.0, 20.0}}, 90);
  EXPECT_EQ(corner.view.low, Eigen::Vector2d(7.0, 3.0));
  EXPECT_EQ(corner.view.high, Eigen::Vector2d(10.0, 6.0));
  EXPECT_EQ(corner.grey.at({2, 2}), 90);
  EXPECT_EQ(corner.grey.at({0, 0}), 255);
  EXPECT_TRUE(
      detail::paper_excerpt(sketch, {.low = {11.0, 0.0}, .high = {15.0, 5.0}}, 90).grey.empty());
}

}  // namespace
}  // namespace sketchloc
