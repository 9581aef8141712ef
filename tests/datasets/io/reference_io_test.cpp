#include "datasets/io/reference_io.hpp"

#include "tests/datasets/io/files.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using testing::content_of;
using testing::FailsWith;
using testing::IsNear;
using ::testing::StartsWith;

constexpr const char* kHeader =
    "t_index,t,sketch_x_px,sketch_y_px,heading_rad,heading_rigid_rad,local_scale_px_per_m,"
    "loo_uncertainty_m,local_rotation_deg_yup,anisotropy,in_image,in_hull,"
    "dist_nearest_correspondence_m\n";

class ReferenceCsv : public testing::FileTest {
 protected:
  std::filesystem::path csv(const std::string& rows) const {
    return file("ref.csv", kHeader + rows);
  }
  auto reading(const std::string& rows) const {
    const std::filesystem::path path = csv(rows);
    return [path] { read_reference(path, 100); };
  }
};

TEST_F(ReferenceCsv, IsTurnedFromTheImageToTheSketchFrame) {
  const Reference reference = read_reference(csv("4,1.5,0,0,9,-0.5,20,0.7,0,1,1,1,2\n"), 100);
  ASSERT_EQ(reference.poses.size(), 1U);
  const ReferencePose& pose = reference.poses[0];
  EXPECT_EQ(pose.step, 4U);
  EXPECT_EQ(pose.time_s, 1.5);
  EXPECT_THAT(pose.sketch_from_robot, IsNear(Sim2::from_xy_yaw_scale(0.5, 99.5, 0.5, 20), 1e-12));
  EXPECT_EQ(pose.uncertainty_m, 0.7);
}

TEST_F(ReferenceCsv, IsScoredOnlyInsideTheImageAndTheHull) {
  const Reference reference =
      read_reference(csv("0,0,0,0,0,0,1,0,0,1,1,1,0\n1,1,0,0,0,0,1,0,0,1,1,0,0\n"
                         "2,2,0,0,0,0,1,0,0,1,0,1,0\n"),
                     100);
  EXPECT_TRUE(reference.poses[0].scored);
  EXPECT_FALSE(reference.poses[1].scored);
  EXPECT_FALSE(reference.poses[2].scored);
}

TEST_F(ReferenceCsv, GivesBackWhatWasWritten) {
  const ReferencePose pose{.step = 3,
                           .time_s = 0.1,
                           .sketch_from_robot = Sim2::from_xy_yaw_scale(12.3, 45.6, -2.5, 17.8),
                           .uncertainty_m = 0.25,
                           .scored = false};
  write_reference(missing("ref.csv"), {.poses = {pose}}, 100);
  EXPECT_THAT(content_of(missing("ref.csv")), StartsWith(kHeader));
  const Reference back = read_reference(missing("ref.csv"), 100);
  ASSERT_EQ(back.poses.size(), 1U);
  EXPECT_EQ(back.poses[0].step, 3U);
  EXPECT_EQ(back.poses[0].uncertainty_m, 0.25);
  EXPECT_FALSE(back.poses[0].scored);
  EXPECT_THAT(back.poses[0].sketch_from_robot, IsNear(pose.sketch_from_robot, 1e-12));
}

TEST_F(ReferenceCsv, NamesLineAndColumnOfAnError) {
  EXPECT_THAT(reading(""), FailsWith("rows: expected at least one"));
  EXPECT_THAT(reading("0,0,0\n"), FailsWith("ref.csv:2: columns: expected 13 as in the header"));
  EXPECT_THAT(reading("0,0,x,0,0,0,1,0,0,1,1,1,0\n"),
              FailsWith("ref.csv:2: sketch_x_px: expected"));
  EXPECT_THAT(reading("0,0,0,0,0,nan,1,0,0,1,1,1,0\n"), FailsWith("heading_rigid_rad: expected"));
  EXPECT_THAT(reading("0,0,0,0,0,0,0,0,0,1,1,1,0\n"),
              FailsWith("local_scale_px_per_m: expected a number above 0"));
  EXPECT_THAT(reading("0,0,0,0,0,0,1,-1,0,1,1,1,0\n"), FailsWith("loo_uncertainty_m: expected"));
  EXPECT_THAT(reading("0,0,0,0,0,0,1,0,0,1,2,1,0\n"), FailsWith("in_image: expected 0 or 1"));
  EXPECT_THAT(reading("-1,0,0,0,0,0,1,0,0,1,1,1,0\n"), FailsWith("t_index: expected an integer"));
  EXPECT_THAT(reading("1,0,0,0,0,0,1,0,0,1,1,1,0\n1,0,0,0,0,0,1,0,0,1,1,1,0\n"),
              FailsWith("ref.csv:3: t_index: expected more than 1, found \"1\""));
}

TEST_F(ReferenceCsv, NamesTheColumnThatIsMissing) {
  const std::filesystem::path path = file("ref.csv", "t_index,t\n0,0\n");
  EXPECT_THAT([&] { read_reference(path, 100); },
              FailsWith("ref.csv:1: header: expected one column \"sketch_x_px\""));
  EXPECT_THAT([&] { read_reference(file("empty.csv", ""), 100); }, FailsWith("is the file empty?"));
}

TEST_F(ReferenceCsv, HasAlternativePoses) {
  const std::filesystem::path path =
      file("b.csv",
           "t_index,t,sketch_x_px,sketch_y_px,heading_rad,local_scale_px_per_m,distance_to_A_px\n"
           "7,2,10,20,1,15,3.5\n");
  const std::vector<AlternativePose> poses = read_alternative(path, 100);
  ASSERT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses[0].step, 7U);
  EXPECT_EQ(poses[0].distance_px, 3.5);
  EXPECT_THAT(poses[0].sketch_from_robot,
              IsNear(Sim2::from_xy_yaw_scale(10.5, 79.5, -1, 15), 1e-12));
}

}  // namespace
}  // namespace sketchloc
