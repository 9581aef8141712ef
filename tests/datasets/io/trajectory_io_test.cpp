#include "datasets/io/trajectory_io.hpp"

#include "datasets/io/relations_io.hpp"
#include "tests/datasets/io/files.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::content_of;
using testing::FailsWith;
using ::testing::HasSubstr;
using testing::IsNear;

class Tum : public testing::FileTest {
 protected:
  auto reading(std::string_view content) const {
    const std::filesystem::path tum = file("a.tum", content);
    return [tum] { read_tum(tum); };
  }
};

TEST_F(Tum, ReadsPosesInThePlane) {
  const MetricTrajectory trajectory = read_tum(
      file("a.tum", "# comment\n1.5 1 2 9 0 0 0 1\n2.5 1 2 9 0 0 0.70710678 -0.70710678\n"));
  ASSERT_EQ(trajectory.size(), 2U);
  EXPECT_EQ(trajectory[0].time_s, 1.5);
  EXPECT_THAT(trajectory[0].pose, IsNear(Se2::from_xy_yaw(1, 2, 0), 1e-12));
  EXPECT_THAT(trajectory[1].pose, IsNear(Se2::from_xy_yaw(1, 2, -1.5707963267948966), 1e-7));
}

TEST_F(Tum, GivesBackWhatWasWritten) {
  MetricTrajectory trajectory;
  trajectory.append(976052890.244111, Se2::from_xy_yaw(0.1, -1e-9, 3.1));
  trajectory.append(976052890.244112, Se2::from_xy_yaw(1e6, 0.0, -3.1));
  write_tum(missing("b.tum"), trajectory);
  const MetricTrajectory back = read_tum(missing("b.tum"));
  ASSERT_EQ(back.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back[i].time_s, trajectory[i].time_s);
    EXPECT_THAT(back[i].pose, IsNear(trajectory[i].pose, 1e-14));
  }
}

TEST_F(Tum, RefusesPosesInADrawingAndTablesWithCommas) {
  SketchTrajectory trajectory;
  trajectory.append(1.0, Sim2::from_xy_yaw_scale(30.0, 40.0, 0.5, 10.0));
  write_tum(missing("sketch.tum"), trajectory);
  EXPECT_THAT([&] { read_tum(missing("sketch.tum")); },
              FailsWith("sketch.tum:1: frame: expected a trajectory in metres"));
  EXPECT_THAT(reading("t_index,t\n0,1\n"), FailsWith("(a CSV file?)"));
}

TEST_F(Tum, WritesPosesInTheDrawingInPixels) {
  SketchTrajectory trajectory;
  trajectory.append(1.0, Sim2::from_xy_yaw_scale(10, 20, 0, 15));
  write_tum(missing("b.tum"), trajectory);
  EXPECT_THAT(content_of(missing("b.tum")), HasSubstr("\n1 10 20 0 0 0 0 1\n"));
}

TEST_F(Tum, NamesFileLineAndField) {
  EXPECT_THAT(reading(""), FailsWith("a.tum: poses: expected lines of t x y z qx qy qz qw"));
  EXPECT_THAT(reading("1 2 3\n"), FailsWith("a.tum:1: z: expected a value, found the end"));
  EXPECT_THAT(reading("1 nan 3 0 0 0 0 1\n"), FailsWith("a.tum:1: x: expected a number"));
  EXPECT_THAT(reading("1 2 3 0 0 0 0 1 5\n"), FailsWith("columns: expected the end of the line"));
  EXPECT_THAT(reading("1 2 3 0 0 0 0 0\n"), FailsWith("quaternion: expected a norm of 1"));
  EXPECT_THAT(reading("1 2 3 0 0.6 0 0 0.8\n"),
              FailsWith("quaternion: expected a rotation about z only, found qx 0.600000"));
  EXPECT_THAT(reading("1 2 3 0 0 0 0 1\n1 2 3 0 0 0 0 1\n"),
              FailsWith("a.tum:2: t: expected a time after the one before"));
}

class Relations : public testing::FileTest {};

TEST_F(Relations, AreThePoseOfTheSecondInTheFirst) {
  const auto relations = read_relations(file("a.relations", "1 2.5 0.5 -0.25 0 0 0 0.1\n"));
  ASSERT_EQ(relations.size(), 1U);
  EXPECT_EQ(relations[0].first_time_s, 1.0);
  EXPECT_EQ(relations[0].second_time_s, 2.5);
  EXPECT_THAT(relations[0].first_from_second, IsNear(Se2::from_xy_yaw(0.5, -0.25, 0.1), 1e-12));
}

TEST_F(Relations, NameFileLineAndField) {
  EXPECT_THAT([&] { read_relations(file("a", "1 2 3 4 0 0 0\n")); },
              FailsWith("a:1: yaw: expected"));
  EXPECT_THAT([&] { read_relations(file("a", "1 2 3 4 0 0.5 0 0\n")); },
              FailsWith("a:1: roll: expected 0, a motion in the plane, found 0.5"));
  EXPECT_THAT([&] { read_relations(file("a", "# none\n")); }, FailsWith("found none"));
}

}  // namespace
}  // namespace sketchloc
