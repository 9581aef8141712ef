#include "eval/drawing_spline_io.hpp"

#include <nlohmann/json.hpp>

namespace sketchloc {

std::string to_json(const DrawingSpline& spline, const KeyframeRun& run) {
  using Json = nlohmann::ordered_json;
  Json json{
      {"controls", Json::array()},           {"poses", Json::array()},
      {"residual_m", spline.residual_m},     {"effective_parameters", spline.effective_parameters},
      {"noise_factor", spline.noise_factor}, {"converged", spline.converged}};
  for (const Eigen::Vector2d& point : spline.sketch_from_metric.control_points()) {
    const Eigen::Vector2d place = spline.sketch_from_metric(point);
    json["controls"].push_back({{"metric", {point.x(), point.y()}},
                                {"sketch", {place.x(), place.y()}},
                                {"sigma_m", spline.sigma_m(point)}});
  }
  for (std::size_t k = 0; k < spline.metric_from_robot.size(); ++k) {
    const Se2& pose = spline.metric_from_robot[k];
    json["poses"].push_back({{"step", run.keyframes[k].step},
                             {"time_s", run.keyframes[k].time_s},
                             {"metric_from_robot", {pose.x_m(), pose.y_m(), pose.yaw_rad()}}});
  }
  return json.dump(1) + "\n";
}

}  // namespace sketchloc
