#include "registration/network_output.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/check.hpp"
#include "registration/network_input.hpp"
#include "registration/tps.hpp"

namespace sketchloc {
namespace {

const std::vector<Eigen::Vector2d>& unit_controls() {
  static const std::vector<Eigen::Vector2d> controls =
      square_lattice(kControlsPerSide, 2.0, Eigen::Vector2d::Zero());
  return controls;
}

const TpsSolver& unit_solver() {
  static const std::optional<TpsSolver> solver = TpsSolver::factor(unit_controls());
  return *solver;
}

}  // namespace

Sim2 pose_of_residual(std::span<const float> output, const Sim2& prior_sketch_from_robot) {
  check(output.size() == ResidualOutput::kSize, "output of a residual network");
  const std::span<const float> pose = output.subspan(ResidualOutput::kPose, 4);
  return prior_sketch_from_robot *
         Sim2::from_xy_yaw_scale(pose[0], pose[1], pose[2], std::exp(static_cast<double>(pose[3])));
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

std::optional<Sim2> pose_of_published(std::span<const float> sources,
                                      const Eigen::Vector2d& crop_centre_in_sketch,
                                      const LocalWindow& window) {
  check(sources.size() == PublishedOutput::kSplineSize, "output of the published network");
  std::vector<Eigen::Vector2d> values;
  for (std::size_t i = 0; i < unit_controls().size(); ++i) {
    values.emplace_back(sources[2 * i], sources[2 * i + 1]);
  }
  const ThinPlateSpline scan_from_crop = unit_solver().solve(values);
  const Eigen::Vector2d robot_in_scan = -2.0 / window.side_m * window.centre_in_robot();
  const Inversion robot = invert(scan_from_crop, robot_in_scan, Eigen::Vector2d::Zero());
  const Eigen::Matrix2d jacobian = scan_from_crop.jacobian(robot.point);
  if (robot.status != Inversion::Status::Converged || !(jacobian.determinant() > 1e-9)) {
    return std::nullopt;
  }
  const Eigen::Matrix2d crop_from_scan = jacobian.inverse();
  const double half_side_px = 0.5 * published_crop_side_px(window);
  const Eigen::Vector2d position = crop_centre_in_sketch + half_side_px * robot.point;
  const double px_per_m =
      half_side_px / (0.5 * window.side_m) * std::sqrt(crop_from_scan.determinant());
  const double heading_rad = std::atan2(crop_from_scan(1, 0), crop_from_scan(0, 0));
  return Sim2::from_xy_yaw_scale(position.x(), position.y(), heading_rad, px_per_m);
}

}  // namespace sketchloc
