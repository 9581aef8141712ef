#include "motion/state_bytes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace sketchloc {
namespace {

TEST(StateBytes, KeepEveryBit) {
  Se2 rigid = Se2::from_xy_yaw(1.0 / 3.0, -2e9, 3.0);
  Sim2 similarity = Sim2::from_xy_yaw_scale(0.1, 0.2, -1.0, 17.3);
  for (int i = 0; i < 100; ++i) {  // rounding errors that no yaw can say
    rigid = rigid * Se2::from_xy_yaw(0.1, 0.2, 0.3);
    similarity = similarity * Se2::from_xy_yaw(0.1, 0.2, 0.3);
  }
  const Eigen::Matrix2d matrix{{1.0, 2.0}, {3.0, 1.0 / 7.0}};
  StateWriter writer;
  writer.put(true);
  writer.put(std::uint64_t{1} << 63);
  writer.put(rigid);
  writer.put(similarity);
  writer.put(matrix);
  writer.put_list(std::vector<float>{1.5F, -0.0F});
  writer.put_text("drawing");
  writer.put(std::optional<Se2>());
  writer.put(std::optional<Se2>(rigid));

  StateReader reader(writer.bytes());
  EXPECT_TRUE(reader.get<bool>());
  EXPECT_EQ(reader.get<std::uint64_t>(), std::uint64_t{1} << 63);
  const Se2 rigid_again = reader.get_se2();
  EXPECT_EQ(rigid_again.translation(), rigid.translation());
  EXPECT_EQ(rigid_again.rotation(), rigid.rotation());
  const Sim2 similarity_again = reader.get_sim2();
  EXPECT_EQ(similarity_again.translation(), similarity.translation());
  EXPECT_EQ(similarity_again.scaled_rotation(), similarity.scaled_rotation());
  EXPECT_EQ((reader.get_matrix<2, 2>()), matrix);
  const std::vector<float> list = reader.get_list<float>(2);
  EXPECT_EQ(list.front(), 1.5F);
  EXPECT_TRUE(std::signbit(list.back()));
  EXPECT_EQ(reader.get_text(100), "drawing");
  EXPECT_FALSE(reader.get_optional_se2());
  EXPECT_TRUE(reader.get_optional_se2());
  EXPECT_TRUE(reader.at_end());
}

TEST(StateBytes, RefuseWhatNobodyPut) {
  const auto reading = [](auto put, auto get) {
    StateWriter writer;
    put(writer);
    StateReader reader(writer.bytes());
    get(reader);
  };
  const auto four = [](double a, double b, double c, double d) {
    return [=](StateWriter& w) { w.put(a), w.put(b), w.put(c), w.put(d); };
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto se2 = [](StateReader& r) { r.get_se2(); };
  const auto sim2 = [](StateReader& r) { r.get_sim2(); };
  EXPECT_THROW(reading(four(0, 0, 1, 1), se2), std::runtime_error) << "no rotation";
  EXPECT_THROW(reading(four(nan, 0, 1, 0), se2), std::runtime_error);
  EXPECT_THROW(reading(four(0, 0, 0, 0), sim2), std::runtime_error) << "no scale";
  EXPECT_THROW(reading([](StateWriter& w) { w.put(std::uint64_t{5}); },
                       [](StateReader& r) { r.get_list<double>(1000); }),
               std::runtime_error)
      << "too short";
  EXPECT_THROW(reading([](StateWriter& w) { w.put_list(std::vector<float>(5)); },
                       [](StateReader& r) { r.get_list<float>(4); }),
               std::runtime_error)
      << "too long";
}

}  // namespace
}  // namespace sketchloc
