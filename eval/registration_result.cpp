#include "eval/registration_result.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "motion/angles.hpp"
#include "registration/control_grid.hpp"

namespace sketchloc {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Sim2& sketch_from_robot) {
  return {{"x_px", sketch_from_robot.x()},
          {"y_px", sketch_from_robot.y()},
          {"heading_rad", sketch_from_robot.yaw_rad()},
          {"scale_px_per_m", sketch_from_robot.scale()}};
}

Json json_of(const PoseDifference& difference) {
  return {{"shift_m", difference.shift_m},
          {"turn_deg", deg_from_rad(difference.turn_rad)},
          {"scale_ratio", difference.scale_ratio}};
}

Json json_of(const LocalWindow& window) {
  return {{"side_m", window.side_m}, {"cells", window.cells}, {"ahead_m", window.ahead_m}};
}

Json json_of(const std::optional<Eigen::Matrix4d>& covariance) {
  if (!covariance) {
    return nullptr;
  }
  Json rows = Json::array();
  for (int row = 0; row < 4; ++row) {
    rows.push_back({(*covariance)(row, 0), (*covariance)(row, 1), (*covariance)(row, 2),
                    (*covariance)(row, 3)});
  }
  return {{"frame", "robot at the pose: truth = pose * e, e = (x m, y m, heading rad, log scale)"},
          {"matrix", rows}};
}

/// Where the warp takes a lattice of the robot's plane that spans the window.
Json control_points(const Warp& warp, const LocalWindow& window) {
  Json points = Json::array();
  for (const Eigen::Vector2d& point :
       square_lattice(kControlsPerSide, window.side_m, window.centre_in_robot())) {
    const std::optional<PlaneMapPoint> place = warp.sketch_from_robot(point);
    points.push_back({{"x_m", point.x()},
                      {"y_m", point.y()},
                      {"x_px", place ? Json(place->value.x()) : Json(nullptr)},
                      {"y_px", place ? Json(place->value.y()) : Json(nullptr)}});
  }
  return points;
}

Json json_of(const Warp& warp, const LocalWindow& window) {
  const FoldReport folds = find_folds(warp, window);
  return {{"folds", folds.folds()},
          {"min_determinant_px2_per_m2", folds.min_determinant},  // null where it is not a number
          {"control_points", control_points(warp, window)}};
}

void add_registration(Json& json, const RegistrationResult& result) {
  const Registration* found = result.registration ? &*result.registration : nullptr;
  const auto add = [&](const char* key, const auto& value_in) {
    json[key] = found != nullptr ? Json(value_in(*found)) : Json(nullptr);
  };
  using Found = const Registration&;
  add("pose", [](Found r) { return json_of(r.sketch_from_robot); });
  add("from_prior", [&](Found r) {
    return json_of(difference(r.sketch_from_robot, result.prior_sketch_from_robot));
  });
  add("covariance", [](Found r) { return json_of(r.covariance); });
  add("inlier_probability", [](Found r) { return r.inlier_probability; });
  add("alignment", [&](Found) { return result.alignment; });
  add("warp", [&](Found r) { return json_of(r.warp, result.window); });
}

void add_reference(Json& json, const RegistrationResult& result) {
  if (!result.reference) {
    json["reference"] = nullptr;
    json["error"] = nullptr;
    return;
  }
  const Sim2& reference = result.reference->sketch_from_robot;
  json["reference"] = json_of(reference);
  json["reference"]["uncertainty_m"] = result.reference->uncertainty_m;
  json["reference"]["scored"] = result.reference->scored;
  json["error"] = {
      {"prior", json_of(difference(result.prior_sketch_from_robot, reference))},
      {"pose", result.registration
                   ? json_of(difference(result.registration->sketch_from_robot, reference))
                   : Json(nullptr)}};
}

}  // namespace

PoseDifference difference(const Sim2& sketch_from_robot, const Sim2& other_sketch_from_robot) {
  return {
      .shift_m = (sketch_from_robot.translation() - other_sketch_from_robot.translation()).norm() /
                 other_sketch_from_robot.scale(),
      .turn_rad = wrap_rad(sketch_from_robot.yaw_rad() - other_sketch_from_robot.yaw_rad()),
      .scale_ratio = sketch_from_robot.scale() / other_sketch_from_robot.scale()};
}

PoseSigma sigma_of(const Eigen::Matrix4d& covariance) {
  const Eigen::Matrix2d of_position = covariance.topLeftCorner<2, 2>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(of_position, Eigen::EigenvaluesOnly);
  return {.position_m = std::sqrt(std::max(0.0, axes.eigenvalues().maxCoeff())),
          .heading_rad = std::sqrt(std::max(0.0, covariance(2, 2)))};
}

FoldReport find_folds(const Warp& warp, const LocalWindow& window) {
  constexpr double kSpacing_m = 0.5;
  const PlaneBox box =
      PlaneBox{.low = window.centre_in_robot(), .high = window.centre_in_robot()}.grown(
          0.5 * window.side_m);
  return warp.find_folds(box, std::max(33, static_cast<int>(window.side_m / kSpacing_m) + 1));
}

std::string to_json(const RegistrationResult& result, std::span<const NamedText> inputs) {
  Json json = {{"scan", result.step},
               {"time_s", result.time_s},
               {"scans", result.scans},
               {"window", json_of(result.window)},
               {"prior", json_of(result.prior_sketch_from_robot)}};
  add_registration(json, result);
  add_reference(json, result);
  json["milliseconds"] = result.milliseconds;
  json["inputs"] = Json::object();
  for (const NamedText& input : inputs) {
    json["inputs"][input.name] = input.text;
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sketchloc
