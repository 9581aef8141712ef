#include "registration/surface_points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "motion/validate.hpp"

namespace sketchloc {
namespace {

struct EndPoint {
  Eigen::Vector2d point_in_laser;
  double range_m = 0.0;
};

std::vector<EndPoint> near_end_points(const Scan& scan, double max_range_m) {
  std::vector<EndPoint> points;
  points.reserve(scan.ranges_m.size());
  for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
    const double range_m = scan.ranges_m[beam];
    if (scan.is_return(beam) && range_m <= max_range_m) {
      const double angle_rad = scan.angle_rad(beam);
      points.push_back({{range_m * std::cos(angle_rad), range_m * std::sin(angle_rad)}, range_m});
    }
  }
  return points;
}

/// The run of consecutive end points around one, each within support_m of it.
std::span<const EndPoint> neighbours(std::span<const EndPoint> points, std::size_t centre,
                                     double support_m) {
  const auto is_near = [&](std::size_t other) {
    return (points[other].point_in_laser - points[centre].point_in_laser).norm() <= support_m;
  };
  std::size_t first = centre;
  while (first > 0 && is_near(first - 1)) {
    --first;
  }
  std::size_t last = centre;
  while (last + 1 < points.size() && is_near(last + 1)) {
    ++last;
  }
  return points.subspan(first, last - first + 1);
}

/// Normal of the line through the points, towards the laser; none where they form no line.
std::optional<Eigen::Vector2d> fit_normal(std::span<const EndPoint> points, double max_roughness) {
  if (points.size() < 3) {
    return std::nullopt;
  }
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const EndPoint& end : points) {
    mean += end.point_in_laser;
  }
  mean /= static_cast<double>(points.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const EndPoint& end : points) {
    const Eigen::Vector2d offset = end.point_in_laser - mean;
    scatter += offset * offset.transpose();
  }
  // Closed-form eigenvalues of a symmetric 2x2 matrix: middle -+ radius at double the angle.
  const double middle = 0.5 * scatter.trace();
  const double cosine = 0.5 * (scatter(0, 0) - scatter(1, 1));
  const double sine = scatter(0, 1);
  const double radius = std::hypot(cosine, sine);
  const double thin = std::max(middle - radius, 0.0);
  if (!(std::sqrt(thin) <= max_roughness * std::sqrt(middle + radius)) || radius == 0.0) {
    return std::nullopt;
  }
  const double along_rad = 0.5 * std::atan2(sine, cosine);
  const Eigen::Vector2d normal(-std::sin(along_rad), std::cos(along_rad));
  return normal.dot(mean) > 0.0 ? Eigen::Vector2d(-normal) : normal;
}

}  // namespace

void validate(const SurfaceParams& params) {
  require_above("max_range_m", params.max_range_m, 0.0);
  require_at_least("spacing_m", params.spacing_m, 0.0);
  require_above("support_m", params.support_m, 0.0);
  require_above("max_gap_beams", params.max_gap_beams, 0.0);
  require_in_range("max_roughness", params.max_roughness, 1e-6, 1.0);
}

std::vector<SurfacePoint> surface_points_in_robot(const Scan& scan, const SurfaceParams& params) {
  const std::vector<EndPoint> ends = near_end_points(scan, params.max_range_m);
  const Eigen::Matrix2d rotation = scan.robot_from_laser.rotation_matrix();
  std::vector<SurfacePoint> surface;
  surface.reserve(ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const Eigen::Vector2d point_in_robot = scan.robot_from_laser * ends[i].point_in_laser;
    if (!surface.empty() && (surface.back().point - point_in_robot).norm() < params.spacing_m) {
      continue;
    }
    const double beam_gap_m = ends[i].range_m * std::abs(scan.angle_step_rad);
    const double support_m = std::max(params.support_m, params.max_gap_beams * beam_gap_m);
    const auto normal_in_laser = fit_normal(neighbours(ends, i, support_m), params.max_roughness);
    if (normal_in_laser) {
      surface.push_back({point_in_robot, rotation * *normal_in_laser});
    }
  }
  return surface;
}

}  // namespace sketchloc
