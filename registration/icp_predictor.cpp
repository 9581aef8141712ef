#include "registration/icp_predictor.hpp"

#include <omp.h>
#include <open3d/geometry/KDTreeFlann.h>
#include <open3d/geometry/KDTreeSearchParam.h>
#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/FastGlobalRegistration.h>
#include <open3d/pipelines/registration/Feature.h>
#include <open3d/pipelines/registration/Registration.h>
#include <open3d/utility/Logging.h>
#include <open3d/utility/Random.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "registration/control_grid.hpp"

namespace sketchloc {
namespace {

namespace o3d = open3d::pipelines::registration;
using open3d::geometry::PointCloud;
using Points = std::vector<Eigen::Vector2d>;

constexpr std::size_t kMinPoints = 20;  ///< of a cloud that can be matched

/// Open3D starts threads that cost more than they bring on clouds as small as ours, and whose sums
/// differ from run to run; and it warns on stdout.
class QuietSingleThread {
 public:
  QuietSingleThread()
      : threads_(omp_get_max_threads()), verbosity_(open3d::utility::GetVerbosityLevel()) {
    omp_set_num_threads(1);
    open3d::utility::SetVerbosityLevel(open3d::utility::VerbosityLevel::Error);
  }
  ~QuietSingleThread() {
    omp_set_num_threads(threads_);
    open3d::utility::SetVerbosityLevel(verbosity_);
  }
  QuietSingleThread(const QuietSingleThread&) = delete;
  QuietSingleThread& operator=(const QuietSingleThread&) = delete;

 private:
  int threads_;
  open3d::utility::VerbosityLevel verbosity_;
};

/// A cloud in the plane z = 0 and what its points look like.
struct DescribedCloud {
  PointCloud cloud;
  o3d::Feature features;
};

bool in_square(const Eigen::Vector2d& point, double side) {
  return point.cwiseAbs().maxCoeff() <= 0.5 * side;
}

/// End points, and points between those of neighbouring beams: strokes have no gaps, and features
/// are alike in equally dense clouds only.
Points wall_points_in_robot(std::span<const PlacedScan> submap, const IcpParams& params) {
  Points points;
  const auto add = [&](const Eigen::Vector2d& point) {
    if (in_square(point, params.side_m)) {
      points.push_back(point);
    }
  };
  const std::size_t scans =
      std::min(submap.size(), static_cast<std::size_t>(std::max(1, params.max_scans)));
  for (const PlacedScan& placed : submap.first(scans)) {
    std::optional<Eigen::Vector2d> last;
    for (const Eigen::Vector2d& end_point : end_points_in_robot(*placed.scan)) {
      const Eigen::Vector2d point = placed.robot_from_then * end_point;
      const double gap_m = last ? (point - *last).norm() : 0.0;
      if (last && gap_m <= params.max_gap_m) {
        const int steps = static_cast<int>(std::ceil(2.0 * gap_m / params.voxel_m));
        for (int step = 1; step < steps; ++step) {
          add(*last + (point - *last) * step / steps);
        }
      }
      add(point);
      last = point;
    }
  }
  return points;
}

/// Strokes in the robot frame of the prior.
Points stroke_points_in_prior(const SketchCropper& drawing, const Sim2& prior_sketch_from_robot,
                              double side_m) {
  const double radius_px = 0.5 * std::numbers::sqrt2 * side_m * prior_sketch_from_robot.scale();
  Points points = drawing.ink_near(prior_sketch_from_robot.translation(), radius_px);
  const Sim2 prior_from_sketch = prior_sketch_from_robot.inverse();
  std::ranges::transform(points, points.begin(),
                         [&](const Eigen::Vector2d& point) { return prior_from_sketch * point; });
  std::erase_if(points, [&](const Eigen::Vector2d& point) { return !in_square(point, side_m); });
  return points;
}

/// Across the line through the neighbours, on the side of the robot.
Eigen::Vector3d normal_at(const Eigen::Vector3d& point, const PointCloud& flat,
                          const std::vector<int>& neighbours) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
  for (const int neighbour : neighbours) {
    const Eigen::Vector2d offset =
        (flat.points_[static_cast<std::size_t>(neighbour)] - point).head<2>();
    mean += offset;
    second += offset * offset.transpose();
  }
  const auto count = static_cast<double>(neighbours.size());  // the point itself is one of them
  mean /= count;
  const Eigen::Matrix2d spread = second / count - mean * mean.transpose();
  const double along_rad = 0.5 * std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
  const Eigen::Vector3d normal(-std::sin(along_rad), std::cos(along_rad), 0.0);
  return normal.dot(point) > 0.0 ? Eigen::Vector3d(-normal) : normal;
}

PointCloud flat_cloud(const Points& points, const IcpParams& params) {
  PointCloud dense;
  for (const Eigen::Vector2d& point : points) {
    dense.points_.emplace_back(point.x(), point.y(), 0.0);
  }
  PointCloud flat = *dense.VoxelDownSample(params.voxel_m);
  const open3d::geometry::KDTreeFlann tree(flat);
  for (const Eigen::Vector3d& point : flat.points_) {
    std::vector<int> neighbours;
    std::vector<double> squared_m2;
    tree.SearchRadius(point, params.normal_radius_m, neighbours, squared_m2);
    flat.normals_.push_back(normal_at(point, flat, neighbours));
  }
  return flat;
}

/// Features are those of the middle layer of walls that are some layers high. Matching that layer
/// alone keeps what follows a problem of the plane: no tilt, no wall upside down.
DescribedCloud described(const Points& points, const IcpParams& params) {
  if (points.size() < kMinPoints) {
    return {};
  }
  DescribedCloud described{.cloud = flat_cloud(points, params), .features = {}};
  const std::vector<Eigen::Vector3d>& flat = described.cloud.points_;
  const std::vector<Eigen::Vector3d>& normals = described.cloud.normals_;
  const int middle = params.layers / 2;
  PointCloud walls;
  for (int layer = 0; layer < params.layers; ++layer) {
    const Eigen::Vector3d lift(0.0, 0.0, (layer - middle) * params.voxel_m);
    for (const Eigen::Vector3d& point : flat) {
      walls.points_.push_back(point + lift);
    }
    walls.normals_.insert(walls.normals_.end(), normals.begin(), normals.end());
  }
  const auto features = o3d::ComputeFPFHFeature(
      walls, open3d::geometry::KDTreeSearchParamRadius(params.feature_radius_m));
  const auto count = static_cast<Eigen::Index>(flat.size());
  described.features.data_ = features->data_.middleCols(middle * count, count);
  return described;
}

/// None where too few features match.
std::optional<Eigen::Matrix4d> globally_aligned(const DescribedCloud& scan,
                                                const DescribedCloud& strokes,
                                                const IcpParams& params) {
  o3d::FastGlobalRegistrationOption option;
  option.use_absolute_scale_ = true;
  option.maximum_correspondence_distance_ = 2.0 * params.voxel_m;
  option.tuple_scale_ = params.tuple_scale;
  option.maximum_tuple_count_ = params.tuples;
  open3d::utility::random::Seed(1);
  try {
    const Eigen::Matrix4d aligned =
        o3d::FastGlobalRegistrationBasedOnFeatureMatching(scan.cloud, strokes.cloud, scan.features,
                                                          strokes.features, option)
            .transformation_;
    // With less than ten matches Open3D lays one cloud's mean on the other's.
    if (aligned.topLeftCorner<3, 3>() == Eigen::Matrix3d::Identity()) {
      return std::nullopt;
    }
    return aligned;
  } catch (const std::runtime_error&) {  // Open3D's answer where not a single feature matches
    return std::nullopt;
  }
}

class IcpPredictor final : public WarpPredictor {
 public:
  explicit IcpPredictor(const IcpParams& params)
      : params_((validate(params), params)),
        controls_in_robot_(
            square_lattice(kControlsPerSide, params.side_m, Eigen::Vector2d::Zero())) {}

  std::vector<std::optional<Registration>> predict(std::span<const PlacedScan> submap,
                                                   const SketchCropper& drawing,
                                                   std::span<const Sim2> priors) override {
    const QuietSingleThread quiet;
    const DescribedCloud scan = described(wall_points_in_robot(submap, params_), params_);
    std::vector<std::optional<Registration>> results;
    for (const Sim2& prior : priors) {
      results.push_back(registered(scan, drawing, prior));
    }
    return results;
  }

 private:
  std::optional<Registration> registered(const DescribedCloud& scan, const SketchCropper& drawing,
                                         const Sim2& prior) const {
    if (scan.cloud.points_.size() < kMinPoints) {
      return std::nullopt;
    }
    const DescribedCloud strokes =
        described(stroke_points_in_prior(drawing, prior, params_.side_m), params_);
    if (strokes.cloud.points_.size() < kMinPoints) {
      return std::nullopt;
    }
    const std::optional<Eigen::Matrix4d> start = globally_aligned(scan, strokes, params_);
    if (!start) {
      return std::nullopt;
    }
    const o3d::RegistrationResult refined =
        o3d::RegistrationICP(scan.cloud, strokes.cloud, params_.icp_distance_m, *start,
                             o3d::TransformationEstimationPointToPlane(),
                             o3d::ICPConvergenceCriteria(1e-6, 1e-6, params_.icp_iterations));
    return registration(refined.transformation_, refined.fitness_, prior);
  }

  std::optional<Registration> registration(const Eigen::Matrix4d& prior_from_robot, double fitness,
                                           const Sim2& prior) const {
    // In a plain corridor nothing holds the scan along it.
    const Eigen::Vector2d shift_m = prior_from_robot.topRightCorner<2, 1>();
    if (!(fitness > 0.0) || !(shift_m.norm() <= params_.side_m)) {
      return std::nullopt;
    }
    const double turn_rad = std::atan2(prior_from_robot(1, 0), prior_from_robot(0, 0));
    const Sim2 pose = prior * Se2::from_xy_yaw(shift_m.x(), shift_m.y(), turn_rad);
    Points places;
    for (const Eigen::Vector2d& control : controls_in_robot_) {
      places.push_back(pose * control);
    }
    return Registration{
        .warp = *Warp::from_robot_points(controls_in_robot_, places),  // a lattice defines a spline
        .sketch_from_robot = pose,
        .covariance = std::nullopt,
        .inlier_probability = std::clamp(fitness, 0.0, 1.0)};
  }

  IcpParams params_;
  Points controls_in_robot_;
};

}  // namespace

bool icp_is_built() { return true; }

std::unique_ptr<WarpPredictor> make_icp_predictor(const IcpParams& params) {
  return std::make_unique<IcpPredictor>(params);
}

}  // namespace sketchloc
