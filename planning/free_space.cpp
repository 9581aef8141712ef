#include "planning/free_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "motion/check.hpp"
#include "motion/validate.hpp"
#include "planning/detail/segment_cells.hpp"
#include "registration/distance_field.hpp"

namespace sketchloc {
namespace {

constexpr double kHalfCell_px = 0.5 * std::numbers::sqrt2;  // centre of a px to its corner
constexpr double kBalancedWeight_m = 0.35;  ///< a metre at clearance c costs 1 + (weight / c)^2
constexpr double kSafestWeight_m = 1.5;

/// The integral of a quantity per px along a segment.
double integral(const Grid<float>& per_px, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  double sum = 0.0;
  detail::visit_cells(from, to, [&](const Cell& cell, double way_px) {
    sum += per_px.contains(cell) ? way_px * static_cast<double>(per_px.at(cell)) : 0.0;
  });
  return sum;
}

Grid<float> reach_of(const Grid<std::uint8_t>& blocked) {
  Grid<float> reach_px = distance_field_px(blocked);
  for (int row = 0; row < reach_px.height(); ++row) {
    for (int column = 0; column < reach_px.width(); ++column) {
      float& reach = reach_px.row(row)[static_cast<std::size_t>(column)];
      const int to_edge =
          std::min({column, row, reach_px.width() - 1 - column, reach_px.height() - 1 - row});
      // less what a point may be off the centres of its cell and of the blocked one
      const double certain = std::min<double>(reach, to_edge + 1.0) - 2.0 * kHalfCell_px;
      reach = reach > 0.0F ? static_cast<float>(std::max(certain, 1e-6)) : 0.0F;
    }
  }
  return reach_px;
}

}  // namespace

double BodyParams::clear_m() const {
  return radius_m * std::exp(sigmas * log_scale_sigma) + sigmas * pose_sigma_m;
}

void validate(const BodyParams& body) {
  require_above("radius_m", body.radius_m, 0.0);
  require_at_least("pose_sigma_m", body.pose_sigma_m, 0.0);
  require_at_least("log_scale_sigma", body.log_scale_sigma, 0.0);
  require_at_least("sigmas", body.sigmas, 0.0);
}

std::span<const std::pair<std::string_view, Objective>> names_of(Objective) {
  static constexpr std::array<std::pair<std::string_view, Objective>, 3> kNames = {
      {{"shortest", Objective::Shortest},
       {"balanced", Objective::Balanced},
       {"safest", Objective::Safest}}};
  return kNames;
}

FreeSpace::FreeSpace(const Sketch& sketch, const ScaleField& scale, const BodyParams& body,
                     Objective objective)
    : FreeSpace(distance_field_px(sketch.occupied), scale, body, objective) {}

FreeSpace::FreeSpace(Grid<float> stroke_distance_px, const ScaleField& scale,
                     const BodyParams& body, Objective objective)
    : clearance_m_(std::move(stroke_distance_px)),
      m_per_px_(scale.m_per_px(width_px(), height_px())) {
  validate(body);
  for (int row = 0; row < height_px(); ++row) {
    const std::span<float> clearance = clearance_m_.row(row);
    const std::span<const float> m_per_px = m_per_px_.row(row);
    for (std::size_t i = 0; i < clearance.size(); ++i) {
      // a stroke's px reaches half a px beyond its centre
      clearance[i] = std::max(clearance[i] - 0.5F, 0.0F) * m_per_px[i];
    }
  }
  block(body);
  price(objective);
}

/// Where the body does not fit; exact for its centre in the middle of a px.
void FreeSpace::block(const BodyParams& body) {
  clear_m_ = body.clear_m();
  blocked_ = Grid<std::uint8_t>(width_px(), height_px());
  for (int row = 0; row < height_px(); ++row) {
    for (int column = 0; column < width_px(); ++column) {
      const Cell cell{column, row};
      blocked_.at(cell) = static_cast<double>(clearance_m_.at(cell)) < clear_m_ ? 1 : 0;
    }
  }
  measure_reach(blocked_);
}

void FreeSpace::measure_reach(const Grid<std::uint8_t>& blocked) { reach_px_ = reach_of(blocked); }

void FreeSpace::price(Objective objective) {
  const double weight_m = objective == Objective::Shortest   ? 0.0
                          : objective == Objective::Balanced ? kBalancedWeight_m
                                                             : kSafestWeight_m;
  cost_m_per_px_ = m_per_px_;
  least_m_per_px_ = static_cast<double>(std::ranges::min(m_per_px_.cells()));
  least_cost_m_per_px_ = std::numeric_limits<double>::infinity();
  for (int row = 0; row < height_px(); ++row) {
    for (int column = 0; column < width_px(); ++column) {
      const Cell cell{column, row};
      const double clearance_m =
          std::max(static_cast<double>(clearance_m_.at(cell)), 0.5 * clear_m_);
      const double near = weight_m / clearance_m;
      cost_m_per_px_.at(cell) *= static_cast<float>(1.0 + near * near);
      least_cost_m_per_px_ = std::min(least_cost_m_per_px_, cost_m_per_px(cell));
    }
  }
}

FreeSpace FreeSpace::with_crossings(double cost_m) const {
  FreeSpace open = *this;
  open.measure_reach(Grid<std::uint8_t>(width_px(), height_px()));
  for (int row = 0; row < height_px(); ++row) {
    for (int column = 0; column < width_px(); ++column) {
      const Cell cell{column, row};
      if (blocked_.at(cell) != 0) {
        // spread over the width of what a thin stroke blocks
        const double width_px = 2.0 * clear_m_ / static_cast<double>(m_per_px_.at(cell)) + 1.0;
        open.cost_m_per_px_.at(cell) = static_cast<float>(cost_m / width_px) + m_per_px_.at(cell);
      }
    }
  }
  return open;
}

bool FreeSpace::contains(const Eigen::Vector2d& point_in_sketch) const {
  return reach_px_.contains(cell_at(point_in_sketch));
}

bool FreeSpace::is_free(const Eigen::Vector2d& point_in_sketch) const {
  return is_free(cell_at(point_in_sketch));
}

bool FreeSpace::is_free(const Eigen::Vector2d& from_in_sketch,
                        const Eigen::Vector2d& to_in_sketch) const {
  const double length = (to_in_sketch - from_in_sketch).norm();
  const Eigen::Vector2d direction = length > 0.0
                                        ? Eigen::Vector2d((to_in_sketch - from_in_sketch) / length)
                                        : Eigen::Vector2d::Zero();
  if (!is_free(from_in_sketch)) {
    return false;
  }
  for (double way = 0.0; way < length;) {
    const Eigen::Vector2d point = from_in_sketch + way * direction;
    const Cell cell = detail::cell_ahead(point, direction);
    if (!is_free(cell)) {
      return false;
    }
    way += std::max(static_cast<double>(reach_px_.at(cell)),
                    detail::to_next_cell_px(point, direction));
  }
  return is_free(to_in_sketch);
}

double FreeSpace::clearance_m(const Eigen::Vector2d& point_in_sketch) const {
  const Cell cell = cell_at(point_in_sketch);
  return clearance_m_.contains(cell) ? static_cast<double>(clearance_m_.at(cell)) : 0.0;
}

double FreeSpace::length_m(const Eigen::Vector2d& from_in_sketch,
                           const Eigen::Vector2d& to_in_sketch) const {
  return integral(m_per_px_, from_in_sketch, to_in_sketch);
}

double FreeSpace::cost_m(const Eigen::Vector2d& from_in_sketch,
                         const Eigen::Vector2d& to_in_sketch) const {
  return integral(cost_m_per_px_, from_in_sketch, to_in_sketch);
}

double FreeSpace::px_per_m(const Eigen::Vector2d& point_in_sketch) const {
  const Cell cell = cell_at(point_in_sketch);
  check(m_per_px_.contains(cell), "a place in the drawing");
  return 1.0 / static_cast<double>(m_per_px_.at(cell));
}

std::optional<Eigen::Vector2d> FreeSpace::nearest_free(
    const Eigen::Vector2d& point_in_sketch) const {
  if (is_free(point_in_sketch)) {
    return point_in_sketch;
  }
  std::optional<Eigen::Vector2d> nearest;
  double least_px = std::numeric_limits<double>::infinity();
  for (int row = 0; row < height_px(); ++row) {
    for (int column = 0; column < width_px(); ++column) {
      const Eigen::Vector2d centre = centre_of({column, row});
      const double apart_px = (centre - point_in_sketch).norm();
      if (apart_px < least_px && is_free(Cell{column, row})) {
        least_px = apart_px;
        nearest = centre;
      }
    }
  }
  return nearest;
}

bool FreeSpace::is_crossing(const Eigen::Vector2d& point_in_sketch) const {
  const Cell cell = cell_at(point_in_sketch);
  return !blocked_.contains(cell) || blocked_.at(cell) != 0;
}

}  // namespace sketchloc
