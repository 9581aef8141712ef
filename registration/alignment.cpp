#include "registration/alignment.hpp"

#include <cmath>
#include <optional>

namespace sketchloc {
namespace {

constexpr double kSigma_m = 0.15;

template <typename Place>
double score(std::span<const PlacedScan> submap, const SketchCropper& drawing, double px_per_m,
             const LocalWindow& window, Place&& place) {
  const double half_m = 0.5 * window.side_m;
  double sum = 0.0;
  int count = 0;
  for (const PlacedScan& placed : submap) {
    for (const Eigen::Vector2d& seen : end_points_in_robot(*placed.scan)) {
      const Eigen::Vector2d point = placed.robot_from_then * seen;
      if ((point - window.centre_in_robot()).cwiseAbs().maxCoeff() > half_m) {
        continue;
      }
      ++count;
      if (const std::optional<Eigen::Vector2d> drawn = place(point)) {
        const double away = drawing.distance_px(drawn->cast<float>()) / (px_per_m * kSigma_m);
        sum += std::isfinite(away) ? std::exp(-0.5 * away * away) : 0.0;  // a drawing of nothing
      }
    }
  }
  return count > 0 ? sum / count : 0.0;
}

}  // namespace

double alignment_score(std::span<const PlacedScan> submap, const SketchCropper& drawing,
                       const Warp& warp, const LocalWindow& window) {
  const std::optional<Sim2> pose = warp.pose();
  if (!pose) {
    return 0.0;
  }
  return score(submap, drawing, pose->scale(), window,
               [&](const Eigen::Vector2d& point) -> std::optional<Eigen::Vector2d> {
                 const std::optional<PlaneMapPoint> drawn = warp.sketch_from_robot(point);
                 return drawn ? std::optional(drawn->value) : std::nullopt;
               });
}

double alignment_score(std::span<const PlacedScan> submap, const SketchCropper& drawing,
                       const Sim2& sketch_from_robot, const LocalWindow& window) {
  return score(submap, drawing, sketch_from_robot.scale(), window,
               [&](const Eigen::Vector2d& point) -> std::optional<Eigen::Vector2d> {
                 return sketch_from_robot * point;
               });
}

}  // namespace sketchloc
