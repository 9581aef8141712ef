#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "datasets/grid.hpp"
#include "datasets/sketch.hpp"
#include "planning/scale_field.hpp"

namespace sketchloc {

/// The disc that must fit: the robot, and what is not known of where it is.
struct BodyParams {
  double radius_m = 0.22;        ///< of the robot, > 0
  double pose_sigma_m = 0.0;     ///< error of its pose across the way, >= 0
  double log_scale_sigma = 0.1;  ///< error of the local scale, of the radius in px, >= 0
  double sigmas = 1.0;           ///< how many of these are kept clear, >= 0

  /// What is kept clear of strokes.
  double clear_m() const;
};

template <typename Visitor>
void visit_fields(BodyParams& body, Visitor&& visit) {
  visit("radius_m", body.radius_m);
  visit("pose_sigma_m", body.pose_sigma_m);
  visit("log_scale_sigma", body.log_scale_sigma);
  visit("sigmas", body.sigmas);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const BodyParams& body);

/// What makes a way a good one.
enum class Objective {
  Shortest,
  Balanced,  ///< keeps off strokes where that costs little
  Safest     ///< in the middle of what is free
};
std::span<const std::pair<std::string_view, Objective>> names_of(Objective);

/// Where a robot fits in a drawing and what a way costs there, in real metres. Both are constant
/// within a px, so that checks are exact: a segment is free if all px that it touches are. The
/// what lies beyond the drawing is not free.
class FreeSpace {
 public:
  FreeSpace(const Sketch& sketch, const ScaleField& scale, const BodyParams& body,
            Objective objective);
  /// The same of distance_field_px() of the strokes, which is worth keeping for many spaces.
  FreeSpace(Grid<float> stroke_distance_px, const ScaleField& scale, const BodyParams& body,
            Objective objective);

  /// The same with strokes to be crossed where there is no other way: a door drawn shut. Crossing
  /// one costs as much as so many metres.
  FreeSpace with_crossings(double cost_m) const;

  int width_px() const { return clearance_m_.width(); }
  int height_px() const { return clearance_m_.height(); }
  bool contains(const Eigen::Vector2d& point_in_sketch) const;
  bool is_free(const Eigen::Vector2d& point_in_sketch) const;
  bool is_free(const Cell& cell) const {
    return reach_px_.contains(cell) && reach_px_.at(cell) > 0;
  }
  /// No px that the segment touches is blocked.
  bool is_free(const Eigen::Vector2d& from_in_sketch, const Eigen::Vector2d& to_in_sketch) const;

  /// To the nearest stroke; 0 outside.
  double clearance_m(const Eigen::Vector2d& point_in_sketch) const;
  double length_m(const Eigen::Vector2d& from_in_sketch, const Eigen::Vector2d& to_in_sketch) const;
  /// What the objective makes of the length: never less than it.
  double cost_m(const Eigen::Vector2d& from_in_sketch, const Eigen::Vector2d& to_in_sketch) const;
  /// Of one px of way.
  double cost_m_per_px(const Cell& cell) const {
    return static_cast<double>(cost_m_per_px_.at(cell));
  }
  double m_per_px(const Cell& cell) const { return static_cast<double>(m_per_px_.at(cell)); }
  double least_m_per_px() const { return least_m_per_px_; }
  double least_cost_m_per_px() const { return least_cost_m_per_px_; }
  double px_per_m(const Eigen::Vector2d& point_in_sketch) const;

  /// The free px nearest to a point, as its centre (or the point itself); none: nothing is free.
  std::optional<Eigen::Vector2d> nearest_free(const Eigen::Vector2d& point_in_sketch) const;
  /// Whether a way through here crosses a stroke.
  bool is_crossing(const Eigen::Vector2d& point_in_sketch) const;

 private:
  void block(const BodyParams& body);
  void price(Objective objective);
  void measure_reach(const Grid<std::uint8_t>& blocked);

  Grid<float> clearance_m_;
  Grid<float> m_per_px_;
  Grid<float> cost_m_per_px_;
  Grid<std::uint8_t> blocked_;  ///< by strokes, whether they may be crossed or not
  Grid<float> reach_px_;  ///< from anywhere in a px no blocked one is nearer; 0: it is blocked
  double least_m_per_px_ = 0.0;
  double least_cost_m_per_px_ = 0.0;
  double clear_m_ = 0.0;
};

}  // namespace sketchloc
