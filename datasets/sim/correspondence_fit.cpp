#include "datasets/sim/correspondence_fit.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "datasets/sim/detail/convex_hull.hpp"
#include "motion/check.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

using Kind = CorrespondenceFit::Kind;
using Places = std::span<const PlacePair>;

constexpr int kFoldSamples = 41;  ///< per side of the layout

/// One way to fit; `softness` is the spline's smoothing by the squared spread of the places.
struct Candidate {
  Kind kind;
  double softness = 0.0;
};

/// From the stiffest to the softest: of equal errors the stiffer map wins.
constexpr std::array<Candidate, 8> kCandidates = {{{Kind::Similarity},
                                                   {Kind::Affine},
                                                   {Kind::ThinPlateSpline, 1.0},
                                                   {Kind::ThinPlateSpline, 0.3},
                                                   {Kind::ThinPlateSpline, 0.1},
                                                   {Kind::ThinPlateSpline, 0.03},
                                                   {Kind::ThinPlateSpline, 0.01},
                                                   {Kind::ThinPlateSpline, 0.003}}};

/// The places as two lists.
struct PointLists {
  std::vector<Eigen::Vector2d> in_world;
  std::vector<Eigen::Vector2d> in_sketch;
};

PointLists point_lists(Places places) {
  PointLists lists;
  for (const PlacePair& place : places) {
    lists.in_world.push_back(place.point_in_world);
    lists.in_sketch.push_back(place.point_in_sketch);
  }
  return lists;
}

/// Mean squared distance of the places from their centre, m^2.
double squared_spread_m2(Places places) {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  for (const PlacePair& place : places) {
    centre += place.point_in_world / static_cast<double>(places.size());
  }
  double sum = 0.0;
  for (const PlacePair& place : places) {
    sum += (place.point_in_world - centre).squaredNorm();
  }
  return sum / static_cast<double>(places.size());
}

std::optional<AffineMap> fit_similarity(const PointLists& points) {
  const std::optional<Sim2> sketch_from_world = align_sim2(points.in_world, points.in_sketch);
  if (!sketch_from_world) {
    return std::nullopt;
  }
  const Eigen::Rotation2Dd rotation(sketch_from_world->yaw_rad());
  return AffineMap{.linear = sketch_from_world->scale() * rotation.toRotationMatrix(),
                   .shift = sketch_from_world->translation()};
}

std::optional<AffineMap> fit_affine(const PointLists& points) {
  const Eigen::Index rows = static_cast<Eigen::Index>(points.in_world.size());
  Eigen::Matrix<double, Eigen::Dynamic, 3> design(rows, 3);
  Eigen::Matrix<double, Eigen::Dynamic, 2> values(rows, 2);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const auto index = static_cast<std::size_t>(row);
    design.row(row) << points.in_world[index].transpose(), 1.0;
    values.row(row) = points.in_sketch[index].transpose();
  }
  const Eigen::ColPivHouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, 3>> solver(design);
  if (solver.rank() < 3) {
    return std::nullopt;
  }
  const Eigen::Matrix<double, 3, 2> solution = solver.solve(values);
  return AffineMap{.linear = solution.topRows<2>().transpose(),
                   .shift = solution.row(2).transpose()};
}

template <typename Step>
std::optional<Deformation> as_deformation(std::optional<Step> step) {
  if (!step) {
    return std::nullopt;
  }
  Deformation deformation;
  deformation.then(*std::move(step));
  return deformation;
}

/// None where the places do not determine the map.
std::optional<Deformation> fit(Places places, Kind kind, double smoothing_m2) {
  const PointLists points = point_lists(places);
  if (kind == Kind::Similarity) {
    return as_deformation(fit_similarity(points));
  }
  if (kind == Kind::Affine) {
    return as_deformation(fit_affine(points));
  }
  const std::optional<TpsSolver> solver = TpsSolver::factor(points.in_world, smoothing_m2);
  return solver ? as_deformation(std::optional(solver->solve(points.in_sketch))) : std::nullopt;
}

double error_px(const Deformation& sketch_from_world, const PlacePair& place) {
  return (sketch_from_world(place.point_in_world) - place.point_in_sketch).norm();
}

double rms(std::span<const double> errors) {
  double sum = 0.0;
  for (const double error : errors) {
    sum += error * error;
  }
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

/// The error at each place of a map fitted without it and its neighbours; none where one is
/// missing.
std::optional<std::vector<double>> left_out_errors_px(Places places, Kind kind, double smoothing_m2,
                                                      double same_place_m) {
  std::vector<double> errors_px;
  for (const PlacePair& left_out : places) {
    std::vector<PlacePair> others;
    for (const PlacePair& place : places) {
      if ((place.point_in_world - left_out.point_in_world).norm() > same_place_m) {
        others.push_back(place);
      }
    }
    const std::optional<Deformation> map =
        others.size() < 2 ? std::nullopt : fit(others, kind, smoothing_m2);
    if (!map) {
      return std::nullopt;
    }
    errors_px.push_back(error_px(*map, left_out));
  }
  return errors_px;
}

/// The candidate fitted and measured.
CorrespondenceFit try_candidate(Places places, const Candidate& candidate,
                                const PlaneBox& layout_in_world, double same_place_m) {
  CorrespondenceFit result{.kind = candidate.kind,
                           .smoothing_m2 = candidate.softness * squared_spread_m2(places)};
  const std::optional<Deformation> map = fit(places, candidate.kind, result.smoothing_m2);
  const std::optional<std::vector<double>> errors_px =
      left_out_errors_px(places, candidate.kind, result.smoothing_m2, same_place_m);
  if (!map || !errors_px) {
    return result;
  }
  const auto at = [&](const Eigen::Vector2d& point) { return map->at(point); };
  if (find_folds(at, layout_in_world, kFoldSamples).folds()) {
    result.status = CorrespondenceFit::Status::Folded;
    return result;
  }
  std::vector<double> residuals_px;
  std::vector<double> errors_m;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Matrix2d jacobian = map->at(places[i].point_in_world).jacobian;
    residuals_px.push_back(error_px(*map, places[i]));
    errors_m.push_back((*errors_px)[i] / local_similarity(jacobian).scale);
  }
  result.status = CorrespondenceFit::Status::Fitted;
  result.sketch_from_world = *map;
  result.residual_px = rms(residuals_px);
  result.left_out_px = rms(*errors_px);
  result.left_out_m = rms(errors_m);
  return result;
}

}  // namespace

void validate(const CorrespondenceFitParams& params) {
  require_above("same_place_m", params.same_place_m, 0.0);
}

CorrespondenceFit fit_correspondences(Places places, const PlaneBox& layout_in_world,
                                      const CorrespondenceFitParams& params) {
  using Status = CorrespondenceFit::Status;
  validate(params);
  CorrespondenceFit best;
  if (places.empty()) {
    return best;
  }
  for (const Candidate& candidate : kCandidates) {
    CorrespondenceFit next = try_candidate(places, candidate, layout_in_world, params.same_place_m);
    const bool better = next.status == Status::Fitted &&
                        (best.status != Status::Fitted || next.left_out_px < best.left_out_px);
    if (better || (next.status == Status::Folded && best.status == Status::TooFewPlaces)) {
      best = std::move(next);
    }
  }
  best.hull_in_world = detail::convex_hull(point_lists(places).in_world);
  return best;
}

Reference with_support(Reference reference, const CorrespondenceFit& fit,
                       const MetricTrajectory& world_from_robot) {
  check(reference.poses.size() == world_from_robot.size(), "one true pose per reference pose");
  for (std::size_t i = 0; i < reference.poses.size(); ++i) {
    ReferencePose& pose = reference.poses[i];
    pose.uncertainty_m = fit.left_out_px / pose.sketch_from_robot.scale();
    pose.scored =
        pose.scored && detail::is_inside(fit.hull_in_world, world_from_robot[i].pose.translation());
  }
  return reference;
}

}  // namespace sketchloc
