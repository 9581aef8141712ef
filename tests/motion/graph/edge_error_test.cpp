#include "motion/graph/detail/edge_error.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/matchers.hpp"
#include "tests/support/numeric_jacobian.hpp"

namespace sketchloc {
namespace {

using detail::error_of;
using detail::LinearEdge;
using detail::turned;
using detail::turned_information;
constexpr double kPi = std::numbers::pi;

GraphPose pose_of(const Eigen::Vector4d& numbers) {
  return {.x = numbers[0], .y = numbers[1], .yaw_rad = numbers[2], .log_scale = numbers[3]};
}

/// Laws over kinds of edges and headings of the first vertex.
class EdgeLaws : public ::testing::TestWithParam<std::tuple<EdgeKind, double>> {
 protected:
  const Eigen::Vector4d first_{1.5, -0.7, std::get<1>(GetParam()), 0.3};
  const Eigen::Vector4d second_{-0.4, 2.2, 0.9, -0.2};

  GraphEdge edge() const {
    GraphEdge edge{.kind = std::get<0>(GetParam()), .first = 0, .second = 1};
    edge.measured = {.x = 0.8, .y = -0.1, .yaw_rad = 0.4, .log_scale = 0.1};
    return edge;
  }
};

INSTANTIATE_TEST_SUITE_P(Kinds, EdgeLaws,
                         ::testing::Combine(::testing::Values(EdgeKind::Between, EdgeKind::Prior,
                                                              EdgeKind::Registration,
                                                              EdgeKind::Manhattan),
                                            ::testing::Values(0.0, 0.6, -2.9, kPi, 11.0)));

TEST_P(EdgeLaws, DerivativesAreThoseOfTheError) {
  const LinearEdge linear = linearised(edge(), turned(pose_of(first_)), turned(pose_of(second_)));
  const auto by_first = [&](const Eigen::Vector4d& first) -> Eigen::Vector4d {
    return error_of(edge(), turned(pose_of(first)), turned(pose_of(second_)));
  };
  const auto by_second = [&](const Eigen::Vector4d& second) -> Eigen::Vector4d {
    return error_of(edge(), turned(pose_of(first_)), turned(pose_of(second)));
  };
  EXPECT_TRUE(linear.error.isApprox(by_first(first_), 1e-15));
  EXPECT_TRUE(linear.by_first.isApprox(testing::numeric_jacobian(by_first, first_), 1e-8))
      << linear.by_first;
  const Eigen::Matrix4d numeric = testing::numeric_jacobian(by_second, second_);
  EXPECT_TRUE((linear.by_second - numeric).isZero(1e-8)) << linear.by_second;
}

/// The squared error in the words of the header: inverse(measured) * estimated.
double chi2_by_poses(const GraphEdge& edge, const Sim2& first, const Sim2& second) {
  Sim2 estimated = first;
  if (edge.kind == EdgeKind::Registration) {
    estimated = first * second;
  } else if (edge.kind != EdgeKind::Prior) {
    estimated = first.inverse() * second;
  }
  const Sim2 error = to_sim2(edge.measured).inverse() * estimated;
  const double period = edge.kind == EdgeKind::Manhattan ? kPi / 2.0 : 2.0 * kPi;
  const Eigen::Vector4d r(error.x(), error.y(), std::remainder(error.yaw_rad(), period),
                          std::log(error.scale()));
  return r.dot(edge.information * r);
}

TEST_P(EdgeLaws, TheSquareIsThatOfTheMeasurementsInverseTimesTheEstimate) {
  GraphEdge edge = this->edge();
  Eigen::Matrix4d root;
  root << 1.0, 0.2, -0.3, 0.1, 0.0, 2.0, 0.4, 0.2, 0.0, 0.0, 0.7, -0.1, 0.0, 0.0, 0.0, 1.3;
  edge.information = root * root.transpose();
  const Eigen::Vector4d error = error_of(edge, turned(pose_of(first_)), turned(pose_of(second_)));
  EXPECT_NEAR(error.dot(turned_information(edge) * error),
              chi2_by_poses(edge, to_sim2(pose_of(first_)), to_sim2(pose_of(second_))), 1e-10);
}

TEST(EdgeError, WrapsTheHeadingWhereverItStands) {
  GraphEdge edge{.kind = EdgeKind::Between, .first = 0, .second = 1};
  edge.measured.yaw_rad = 3.0;
  const Eigen::Vector4d error =
      error_of(edge, turned({.yaw_rad = 100.0 * kPi + 0.1}), turned({.yaw_rad = -3.0}));
  EXPECT_NEAR(error[2], 2.0 * kPi - 6.1, 1e-12);
}

TEST(EdgeError, QuarterTurnsAreNoErrorOnAManhattanEdge) {
  const GraphEdge edge = manhattan_edge(0, 1, ManhattanAxis::Forward, 0.1, 0.05);
  for (const double turn : {-1.0, 0.0, 1.0, 2.0, 7.0}) {
    const Eigen::Vector4d error =
        error_of(edge, turned({.x = 1.0, .yaw_rad = kPi / 2.0}),
                 turned({.x = 1.0, .y = 12.0, .yaw_rad = turn * kPi / 2.0 + 0.05}));
    EXPECT_NEAR(error.dot(turned_information(edge) * error), 1.0, 1e-9);
  }
}

TEST(EdgeError, AnOffsetAcrossTheAisleIsAnErrorAndOneAlongItIsNot) {
  const GraphEdge forward = manhattan_edge(0, 1, ManhattanAxis::Forward, 0.1, 0.05);
  const GraphEdge sideways = manhattan_edge(0, 1, ManhattanAxis::Sideways, 0.1, 0.05);
  const GraphPose ahead{.x = 12.0, .y = 0.2};
  const Eigen::Vector4d error = error_of(forward, turned({}), turned(ahead));
  EXPECT_NEAR(error.dot(forward.information * error), 4.0, 1e-9);
  EXPECT_NEAR(error.dot(sideways.information * error), 14400.0, 1e-6);
}

}  // namespace
}  // namespace sketchloc
