#include "datasets/sim/scan_agreement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "motion/check.hpp"
#include "registration/distance_field.hpp"
#include "registration/ray_caster.hpp"

namespace sketchloc {
namespace {

constexpr double kNearest_m = 0.1;
constexpr double kFarthest_m = 20.0;
constexpr double kNearStroke_m = 0.5;
constexpr float kLeastExpected_px = 0.5F;  ///< a robot on a stroke

/// What one return says.
struct Return {
  double log_ratio;
  bool near_stroke;
  bool near_stroke_mirrored;
};

/// The drawing as the beams see it.
class Strokes {
 public:
  explicit Strokes(const Sketch& sketch)
      : caster_(sketch.occupied),
        distance_px_(distance_field_px(sketch.occupied)),
        diagonal_px_(std::hypot(sketch.width_px(), sketch.height_px())) {}

  Return look(const Sim2& sketch_from_laser, double bearing_rad, double range_m) const {
    const double scale_px_per_m = sketch_from_laser.scale();
    const double heading_rad = sketch_from_laser.yaw_rad() + bearing_rad;
    const float expected_px =
        caster_.range(sketch_from_laser.translation(), static_cast<float>(heading_rad),
                      static_cast<float>(diagonal_px_));
    const double ratio = range_m * scale_px_per_m / std::max(expected_px, kLeastExpected_px);
    return {.log_ratio = std::log(ratio),
            .near_stroke = near(sketch_from_laser, bearing_rad, range_m),
            .near_stroke_mirrored = near(sketch_from_laser, -bearing_rad, range_m)};
  }

 private:
  bool near(const Sim2& sketch_from_laser, double bearing_rad, double range_m) const {
    const Eigen::Vector2d end_in_laser =
        range_m * Eigen::Vector2d(std::cos(bearing_rad), std::sin(bearing_rad));
    const Cell cell = cell_at(sketch_from_laser * end_in_laser);
    return distance_px_.contains(cell) &&
           distance_px_.at(cell) < kNearStroke_m * sketch_from_laser.scale();
  }

  RayCaster caster_;
  Grid<float> distance_px_;
  double diagonal_px_;
};

std::vector<Return> look_at_all(const Sketch& sketch, const Run& run, const Reference& reference) {
  const Strokes strokes(sketch);
  std::vector<Return> returns;
  for (const ReferencePose& pose : reference.poses) {
    if (!pose.scored) {
      continue;
    }
    check(pose.step < run.steps.size(), "a reference belongs to its run");
    const Scan& scan = run.steps[pose.step].scan;
    const Sim2 sketch_from_laser = pose.sketch_from_robot * scan.robot_from_laser;
    for (std::size_t beam = 0; beam < scan.ranges_m.size(); ++beam) {
      const double range_m = scan.ranges_m[beam];
      if (scan.is_return(beam) && range_m >= kNearest_m && range_m <= kFarthest_m) {
        returns.push_back(strokes.look(sketch_from_laser, scan.angle_rad(beam), range_m));
      }
    }
  }
  return returns;
}

template <typename Holds>
double share_of(const std::vector<Return>& returns, const Holds& holds) {
  return static_cast<double>(std::ranges::count_if(returns, holds)) /
         static_cast<double>(returns.size());
}

/// The value that a share of all log ratios is below.
double log_ratio_at(std::vector<Return>& returns, double share) {
  const auto position =
      static_cast<std::ptrdiff_t>(share * static_cast<double>(returns.size() - 1));
  const auto nth = returns.begin() + position;
  std::ranges::nth_element(returns, nth, {}, &Return::log_ratio);
  return nth->log_ratio;
}

}  // namespace

ScanAgreement measure_agreement(const Sketch& sketch, const Run& run, const Reference& reference) {
  std::vector<Return> returns = look_at_all(sketch, run, reference);
  if (returns.empty()) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    return {0, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone};
  }
  const auto within = [&](double bound) {
    return share_of(returns,
                    [bound](const Return& one) { return std::abs(one.log_ratio) < bound; });
  };
  return {.returns = returns.size(),
          .median_log_ratio = log_ratio_at(returns, 0.5),
          .log_ratio_p25 = log_ratio_at(returns, 0.25),
          .log_ratio_p75 = log_ratio_at(returns, 0.75),
          .share_within_0_1 = within(0.1),
          .share_within_0_3 = within(0.3),
          .share_within_0_6 = within(0.6),
          .share_short = share_of(returns, [](const Return& one) { return one.log_ratio < -0.6; }),
          .share_long = share_of(returns, [](const Return& one) { return one.log_ratio > 0.6; }),
          .share_near_stroke = share_of(returns, &Return::near_stroke),
          .share_near_stroke_mirrored = share_of(returns, &Return::near_stroke_mirrored)};
}

}  // namespace sketchloc
