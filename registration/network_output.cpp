#include "registration/network_output.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/check.hpp"
#include "registration/network_input.hpp"

namespace sketchloc {
namespace {

const std::vector<Eigen::Vector2d>& unit_controls() {
  static const std::vector<Eigen::Vector2d> controls =
      square_lattice(kControlsPerSide, 2.0, Eigen::Vector2d::Zero());
  return controls;
}

}  // namespace

Sim2 pose_of_residual(std::span<const float> output, const Sim2& prior_sketch_from_robot,
                      const LocalWindow& window) {
  check(output.size() == ResidualOutput::kSize, "output of a residual network");
  const std::span<const float> pose = output.subspan(ResidualOutput::kPose, 4);
  return prior_sketch_from_robot * Sim2::from_xy_yaw_scale(unit_m(window) * pose[0],
                                                           unit_m(window) * pose[1], pose[2],
                                                           std::exp(static_cast<double>(pose[3])));
}

Eigen::Matrix4d whitening_of_residual(std::span<const float> output) {
  check(output.size() == ResidualOutput::kSize, "output of a residual network");
  const std::span<const float> values = output.subspan(ResidualOutput::kWhitening, 10);
  Eigen::Matrix4d whitening = Eigen::Matrix4d::Zero();
  std::size_t next = 4;
  for (int row = 0; row < 4; ++row) {
    const double log_precision =
        std::clamp(static_cast<double>(values[static_cast<std::size_t>(row)]),
                   ResidualOutput::kMinLogPrecision, ResidualOutput::kMaxLogPrecision);
    whitening(row, row) = std::exp(log_precision);
    for (int column = 0; column < row; ++column) {
      whitening(row, column) = values[next++];
    }
  }
  return whitening;
}

std::array<float, PublishedOutput::kSplineSize> sources_of_affine(std::span<const float> output) {
  check(output.size() == PublishedOutput::kAffineSize, "output of the affine network");
  std::array<float, PublishedOutput::kSplineSize> sources{};
  for (std::size_t i = 0; i < unit_controls().size(); ++i) {
    const Eigen::Vector2f target = unit_controls()[i].cast<float>();
    sources[2 * i] = output[0] * target.x() + output[1] * target.y() + output[2];
    sources[2 * i + 1] = output[3] * target.x() + output[4] * target.y() + output[5];
  }
  return sources;
}

Warp warp_of_residual(std::span<const float> output, const Sim2& prior_sketch_from_robot,
                      const LocalWindow& window) {
  check(output.size() == ResidualOutput::kSize, "output of a residual network");
  const std::vector<Eigen::Vector2d> controls =
      square_lattice(kControlsPerSide, window.side_m, window.centre_in_robot());
  std::vector<Eigen::Vector2d> places;
  for (std::size_t i = 0; i < controls.size(); ++i) {
    const std::size_t at = ResidualOutput::kControlShift + 2 * i;
    places.push_back(prior_sketch_from_robot *
                     (controls[i] + unit_m(window) * Eigen::Vector2d(output[at], output[at + 1])));
  }
  return *Warp::from_robot_points(controls, places);  // a lattice defines a spline
}

Eigen::Matrix4d covariance_of_residual(std::span<const float> output, const LocalWindow& window) {
  const Eigen::Matrix4d whitening = whitening_of_residual(output);
  const Eigen::Matrix4d root =
      whitening.triangularView<Eigen::Lower>().solve(Eigen::Matrix4d(Eigen::Matrix4d::Identity()));
  // From the frame of the prior, in its units, to the robot's own, in metres.
  const double yaw_rad = output[ResidualOutput::kPose + 2];
  const double scale = std::exp(static_cast<double>(output[ResidualOutput::kPose + 3]));
  Eigen::Matrix4d robot_from_prior = Eigen::Matrix4d::Identity();
  robot_from_prior.topLeftCorner<2, 2>() =
      Sim2::from_xy_yaw_scale(0.0, 0.0, -yaw_rad, unit_m(window) / scale).scaled_rotation_matrix();
  const Eigen::Matrix4d mapped = robot_from_prior * root;
  return mapped * mapped.transpose();
}

double inlier_probability_of_residual(std::span<const float> output) {
  return 1.0 / (1.0 + std::exp(-static_cast<double>(output[ResidualOutput::kInlierLogit])));
}

Warp warp_of_published(std::span<const float> sources, const Eigen::Vector2d& crop_centre_in_sketch,
                       const LocalWindow& window) {
  check(sources.size() == PublishedOutput::kSplineSize, "output of the published network");
  const std::vector<Eigen::Vector2d> places =
      square_lattice(kControlsPerSide, published_crop_side_px(window), crop_centre_in_sketch);
  std::vector<Eigen::Vector2d> points;
  for (std::size_t i = 0; i < places.size(); ++i) {
    points.emplace_back(window.centre_in_robot() +
                        0.5 * window.side_m * Eigen::Vector2d(sources[2 * i], sources[2 * i + 1]));
  }
  return *Warp::from_sketch_places(places, points);  // a lattice defines a spline
}

std::optional<Sim2> pose_of_published(std::span<const float> sources,
                                      const Eigen::Vector2d& crop_centre_in_sketch,
                                      const LocalWindow& window) {
  const std::optional<PlaneMapPoint> robot =
      warp_of_published(sources, crop_centre_in_sketch, window)
          .sketch_from_robot(Eigen::Vector2d::Zero());
  if (!robot || !(robot->jacobian.determinant() > 0.0)) {
    return std::nullopt;
  }
  return Sim2::from_xy_yaw_scale(robot->value.x(), robot->value.y(),
                                 std::atan2(robot->jacobian(1, 0), robot->jacobian(0, 0)),
                                 std::sqrt(robot->jacobian.determinant()));
}

}  // namespace sketchloc
