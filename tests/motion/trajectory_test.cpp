#include "motion/trajectory.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>
#include <numbers>

#include "motion/random.hpp"
#include "tests/support/matchers.hpp"

namespace sketchloc {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using testing::IsNear;
using ::testing::Pair;
using Points = std::vector<Eigen::Vector2d>;
using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
constexpr double kPi = std::numbers::pi;

// ---- Trajectory ----------------------------------------------------------------------------

MetricTrajectory quarter_circle() {
  MetricTrajectory world_from_robot;
  world_from_robot.append(10.0, Se2());
  world_from_robot.append(12.0, Se2::exp({kPi / 2.0, 0.0, kPi / 2.0}));  // radius 1 m
  return world_from_robot;
}

TEST(Trajectory, GivesItsOwnPosesAtTheirTimes) {
  const MetricTrajectory path = quarter_circle();
  EXPECT_THAT(path.at(10.0).value(), IsNear(path[0].pose, 0.0));
  EXPECT_THAT(path.at(12.0).value(), IsNear(path[1].pose, 0.0));
}

TEST(Trajectory, InterpolatesAlongTheArc) {
  const Se2 halfway = quarter_circle().at(11.0).value();
  const double half = std::sqrt(0.5);
  EXPECT_THAT(halfway, IsNear(Se2::from_xy_yaw(half, 1.0 - half, kPi / 4.0), 1e-14));
}

TEST(Trajectory, InterpolatesTheScaleGeometrically) {
  SketchTrajectory sketch_from_robot;
  sketch_from_robot.append(0.0, Sim2::from_xy_yaw_scale(5.0, 5.0, 0.0, 10.0));
  sketch_from_robot.append(1.0, Sim2::from_xy_yaw_scale(5.0, 5.0, 0.0, 40.0));
  EXPECT_NEAR(sketch_from_robot.at(0.5)->scale(), 20.0, 1e-13);
}

TEST(Trajectory, IsSilentOutsideItsTime) {
  const MetricTrajectory path = quarter_circle();
  EXPECT_FALSE(path.at(9.999).has_value());
  EXPECT_FALSE(path.at(12.001).has_value());
  EXPECT_FALSE(path.at(std::numeric_limits<double>::quiet_NaN()).has_value());
  EXPECT_FALSE(MetricTrajectory().at(0.0).has_value());
}

TEST(Trajectory, OfOnePoseKnowsThatInstantAlone) {
  const MetricTrajectory path({{.time_s = 1.0, .pose = Se2()}});
  EXPECT_TRUE(path.at(1.0).has_value());
  EXPECT_FALSE(path.at(1.5).has_value());
}

TEST(TrajectoryDeathTest, RefusesTimesThatDoNotIncrease) {
  MetricTrajectory path = quarter_circle();
  EXPECT_DEATH(path.append(12.0, Se2()), "must increase");
  EXPECT_DEATH(MetricTrajectory({{2.0, Se2()}, {1.0, Se2()}}), "must increase");
}

// ---- match_by_time -------------------------------------------------------------------------

/// The slow, obvious way: again and again the closest pair of all that are left and cross no other.
Pairs match_slowly(const std::vector<double>& first_s, const std::vector<double>& second_s,
                   double max_gap_s) {
  std::vector<bool> first_used(first_s.size());
  std::vector<bool> second_used(second_s.size());
  Pairs pairs;
  const auto crosses = [&pairs](std::size_t i, std::size_t j) {
    return std::ranges::any_of(
        pairs, [&](const auto& pair) { return (pair.first < i) != (pair.second < j); });
  };
  while (true) {
    double best_gap_s = max_gap_s;
    std::optional<std::pair<std::size_t, std::size_t>> best;
    for (std::size_t i = 0; i < first_s.size(); ++i) {
      for (std::size_t j = 0; j < second_s.size(); ++j) {
        const double gap_s = std::abs(first_s[i] - second_s[j]);
        if (!first_used[i] && !second_used[j] && gap_s <= best_gap_s && !crosses(i, j)) {
          best_gap_s = gap_s;
          best = {i, j};
        }
      }
    }
    if (!best) {
      std::ranges::sort(pairs);
      return pairs;
    }
    first_used[best->first] = second_used[best->second] = true;
    pairs.push_back(*best);
  }
}

TEST(MatchByTime, PairsTheNearest) {
  const std::vector<double> first_s = {0.0, 1.0, 2.0};
  const std::vector<double> second_s = {0.1, 0.9, 5.0};
  EXPECT_THAT(match_by_time(first_s, second_s, 0.2), ElementsAre(Pair(0u, 0u), Pair(1u, 1u)));
}

TEST(MatchByTime, UsesEachTimeOnceAndServesTheClosestFirst) {
  const std::vector<double> first_s = {1.0, 1.3};
  const std::vector<double> second_s = {1.2};
  EXPECT_THAT(match_by_time(first_s, second_s, 1.0), ElementsAre(Pair(1u, 0u)));
}

TEST(MatchByTime, NeverLetsPairsCross) {
  const std::vector<double> first_s = {0.0, 1.0};
  const std::vector<double> second_s = {0.9, 2.0};
  EXPECT_THAT(match_by_time(first_s, second_s, 2.0), ElementsAre(Pair(1u, 0u)));
}

TEST(MatchByTime, PairsEqualTimesInTheirOrder) {
  const std::vector<double> first_s = {1.0, 1.0, 1.0, 2.0};
  const std::vector<double> second_s = {1.0, 1.0, 2.0};
  EXPECT_THAT(match_by_time(first_s, second_s, 0.5),
              ElementsAre(Pair(0u, 0u), Pair(1u, 1u), Pair(3u, 2u)));
}

TEST(MatchByTime, AllowsTheGapItselfAndNothingBeyond) {
  const std::vector<double> first_s = {0.0};
  const std::vector<double> second_s = {0.25};
  EXPECT_THAT(match_by_time(first_s, second_s, 0.25), ElementsAre(Pair(0u, 0u)));
  EXPECT_THAT(match_by_time(first_s, second_s, 0.2499), IsEmpty());
}

TEST(MatchByTime, FindsNothingInEmptyLists) {
  const std::vector<double> times_s = {0.0, 1.0};
  EXPECT_THAT(match_by_time({}, times_s, 1.0), IsEmpty());
  EXPECT_THAT(match_by_time(times_s, {}, 1.0), IsEmpty());
}

TEST(MatchByTime, AgreesWithTheSlowWayOnRandomTimes) {
  Rng rng = make_rng(3);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> first_s(static_cast<std::size_t>(uniform(0.0, 20.0, rng)));
    std::vector<double> second_s(static_cast<std::size_t>(uniform(0.0, 20.0, rng)));
    for (std::vector<double>* times_s : {&first_s, &second_s}) {
      std::ranges::generate(*times_s, [&rng] { return uniform(0.0, 10.0, rng); });
      std::ranges::sort(*times_s);
    }
    const double max_gap_s = uniform(0.0, 2.0, rng);
    ASSERT_EQ(match_by_time(first_s, second_s, max_gap_s),
              match_slowly(first_s, second_s, max_gap_s));
  }
}

TEST(MatchByTime, StaysFastWhereTheGapCoversEverything) {
  std::vector<double> times_s(20'000);
  for (std::size_t i = 0; i < times_s.size(); ++i) {
    times_s[i] = static_cast<double>(i);
  }
  EXPECT_EQ(match_by_time(times_s, times_s, 1e9).size(), times_s.size());
}

TEST(MatchByTimeDeathTest, RefusesTimesThatDecrease) {
  const std::vector<double> times_s = {1.0, 0.0};
  EXPECT_DEATH(match_by_time(times_s, times_s, 1.0), "must not decrease");
}

// ---- alignment -----------------------------------------------------------------------------

Points random_points(std::size_t count, double size, Rng& rng) {
  Points points(count);
  for (Eigen::Vector2d& point : points) {
    point = {uniform(-size, size, rng), uniform(-size, size, rng)};
  }
  return points;
}

template <typename Transform>
Points moved(const Transform& transform, const Points& points, double noise, Rng& rng) {
  Points result;
  for (const Eigen::Vector2d& point : points) {
    result.push_back(transform * point +
                     Eigen::Vector2d(gaussian(noise, rng), gaussian(noise, rng)));
  }
  return result;
}

template <typename Transform>
double squared_error(const Transform& transform, const Points& from, const Points& to) {
  double sum = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    sum += (transform * from[i] - to[i]).squaredNorm();
  }
  return sum;
}

/// Best rigid motion by search: every yaw in steps, refined ten-fold around the best, eight times.
Se2 align_slowly(const Points& from, const Points& to) {
  Eigen::Vector2d from_mean = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_mean = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    from_mean += from[i] / static_cast<double>(from.size());
    to_mean += to[i] / static_cast<double>(to.size());
  }
  double centre_rad = 0.0;
  Se2 best;
  double best_error = std::numeric_limits<double>::infinity();
  for (double reach_rad = kPi; reach_rad > 1e-8; reach_rad /= 10.0) {
    const double around_rad = centre_rad;
    for (int step = -50; step <= 50; ++step) {
      const double yaw_rad = around_rad + reach_rad * step / 50.0;
      const Eigen::Vector2d shift = to_mean - Se2::from_xy_yaw(0.0, 0.0, yaw_rad) * from_mean;
      const Se2 candidate = Se2::from_xy_yaw(shift.x(), shift.y(), yaw_rad);
      const double error = squared_error(candidate, from, to);
      if (error < best_error) {
        best_error = error;
        best = candidate;
        centre_rad = yaw_rad;
      }
    }
  }
  return best;
}

/// Best similarity as the linear least-squares problem that it is: x' = a x - b y + c, ...
Sim2 align_similarity_slowly(const Points& from, const Points& to) {
  const auto rows = static_cast<Eigen::Index>(2 * from.size());
  Eigen::MatrixXd design(rows, 4);
  Eigen::VectorXd target(rows);
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    design.row(row) << from[i].x(), -from[i].y(), 1.0, 0.0;
    design.row(row + 1) << from[i].y(), from[i].x(), 0.0, 1.0;
    target.segment<2>(row) = to[i];
  }
  const Eigen::Vector4d best = design.colPivHouseholderQr().solve(target);
  return Sim2::from_xy_yaw_scale(best[2], best[3], std::atan2(best[1], best[0]),
                                 std::hypot(best[0], best[1]));
}

class Alignment : public ::testing::TestWithParam<double> {
 protected:
  const double yaw_rad_ = GetParam();
};

INSTANTIATE_TEST_SUITE_P(Yaws, Alignment,
                         ::testing::Values(0.0, 1e-9, 1.0, -2.0, kPi - 1e-9, -kPi + 1e-9));

TEST_P(Alignment, FindsARigidMotionExactly) {
  Rng rng = make_rng(4);
  const Se2 truth = Se2::from_xy_yaw(-30.0, 400.0, yaw_rad_);
  const Points from = random_points(10, 20.0, rng);
  EXPECT_THAT(align_se2(from, moved(truth, from, 0.0, rng)), IsNear(truth, 1e-11));
}

TEST_P(Alignment, FindsASimilarityExactly) {
  Rng rng = make_rng(5);
  const Sim2 truth = Sim2::from_xy_yaw_scale(-30.0, 400.0, yaw_rad_, 20.7);
  const Points from = random_points(10, 20.0, rng);
  EXPECT_THAT(align_sim2(from, moved(truth, from, 0.0, rng)).value(), IsNear(truth, 1e-10));
}

TEST_P(Alignment, IsTheRigidMotionThatASearchFinds) {
  Rng rng = make_rng(6);
  const Points from = random_points(12, 5.0, rng);
  const Points to = moved(Se2::from_xy_yaw(3.0, 4.0, yaw_rad_), from, 1.0, rng);
  EXPECT_THAT(align_se2(from, to), IsNear(align_slowly(from, to), 1e-6));
}

TEST_P(Alignment, IsTheSimilarityOfLinearLeastSquares) {
  Rng rng = make_rng(7);
  const Points from = random_points(12, 5.0, rng);
  const Points to = moved(Sim2::from_xy_yaw_scale(3.0, 4.0, yaw_rad_, 15.0), from, 10.0, rng);
  EXPECT_THAT(align_sim2(from, to).value(), IsNear(align_similarity_slowly(from, to), 1e-11));
}

TEST(AlignSe2, GivesAPureTranslationWhereNothingTellsTheTurn) {
  const Points one = {{1.0, 2.0}};
  const Points other = {{4.0, 6.0}};
  EXPECT_THAT(align_se2(one, other), IsNear(Se2::from_xy_yaw(3.0, 4.0, 0.0), 1e-15));
  const Points same(7, Eigen::Vector2d(0.1, 1e6 / 3.0));  // their mean is not exactly representable
  const Points spread = {{0, 0}, {1, 0}, {2, 0}, {3, 1}, {4, 1}, {5, 1}, {6, 5}};
  EXPECT_EQ(align_se2(same, spread).yaw_rad(), 0.0);
  EXPECT_EQ(align_se2(spread, same).yaw_rad(), 0.0);
}

TEST(AlignSe2, GivesAPureTranslationBetweenMirrorImages) {
  const Points square = {{1.1, 1.1}, {-1.1, 1.1}, {-1.1, -1.1}, {1.1, -1.1}};
  const Points mirrored = {{1.1, -1.1}, {-1.1, -1.1}, {-1.1, 1.1}, {1.1, 1.1}};
  EXPECT_EQ(align_se2(square, mirrored).yaw_rad(), 0.0);
  EXPECT_FALSE(align_sim2(square, mirrored).has_value());
}

TEST(AlignSim2, FindsNothingWhereNothingTellsScaleAndTurn) {
  const Points one = {{1.0, 2.0}};
  EXPECT_FALSE(align_sim2(one, one).has_value());
  const Points same(7, Eigen::Vector2d(0.1, 1e6 / 3.0));
  EXPECT_FALSE(align_sim2(same, same).has_value());
}

TEST(AlignSim2, TakesTwoPoints) {
  const Points from = {{0.0, 0.0}, {1.0, 0.0}};
  const Points to = {{5.0, 5.0}, {5.0, 7.0}};
  EXPECT_THAT(align_sim2(from, to).value(),
              IsNear(Sim2::from_xy_yaw_scale(5.0, 5.0, kPi / 2.0, 2.0), 1e-14));
}

TEST(AlignDeathTest, RefusesUnequalOrNoPoints) {
  const Points one = {{1.0, 2.0}};
  EXPECT_DEATH(align_se2(one, {}), "equally many points");
  EXPECT_DEATH(align_sim2({}, {}), "at least one");
}

}  // namespace
}  // namespace sketchloc
