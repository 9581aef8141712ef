#include "registration/train/deformation_table.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "datasets/sim/building.hpp"
#include "datasets/sim/person.hpp"
#include "datasets/sim/plan_generators.hpp"

namespace sketchloc {
namespace {

class DeformationTableTest : public ::testing::Test {
 protected:
  DeformationTableTest() {
    Rng rng = make_rng(7);
    const FloorPlan plan = make_home(rng);
    box_ = bounds_in_world(plan);
    exact_ = draw(plan, human_person(), rng).sketch_from_world;
  }

  Eigen::Vector2d random_place(Rng& rng) const {
    return {uniform(box_.low.x(), box_.high.x(), rng), uniform(box_.low.y(), box_.high.y(), rng)};
  }

  PlaneBox box_;
  Deformation exact_;
};

TEST_F(DeformationTableTest, AgreesWithTheDeformationToAFewCentimetres) {
  const DeformationTable table(exact_, box_);
  Rng rng = make_rng(8);
  double sum_squared_m2 = 0.0;
  constexpr int kPlaces = 2000;
  for (int i = 0; i < kPlaces; ++i) {
    const Eigen::Vector2d place = random_place(rng);
    const PlaneMapPoint truth = exact_.at(place);
    const double error_m = (truth.jacobian.inverse() * (table(place) - truth.value)).norm();
    EXPECT_LT(error_m, 0.05);
    sum_squared_m2 += error_m * error_m;
  }
  EXPECT_LT(std::sqrt(sum_squared_m2 / kPlaces), 0.01);
}

TEST_F(DeformationTableTest, GivesTheDeformationItselfOutside) {
  const DeformationTable table(exact_, box_);
  const Eigen::Vector2d outside = box_.high + Eigen::Vector2d(3.0, 5.0);
  EXPECT_EQ(table(outside), exact_(outside));
}

TEST_F(DeformationTableTest, InverseUndoesIt) {
  const DeformationTable table(exact_, box_);
  Rng rng = make_rng(9);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector2d place = random_place(rng);
    const Inversion inverse = table.inverse(table(place), place + Eigen::Vector2d(0.8, -0.6));
    EXPECT_EQ(inverse.status, Inversion::Status::Converged);
    EXPECT_LT((inverse.point - place).norm(), 0.02);
  }
}

}  // namespace
}  // namespace sketchloc
