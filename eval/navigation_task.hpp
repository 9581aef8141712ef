#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

#include "datasets/sim/data_set.hpp"

namespace sketchloc {

/// Where goals lie, and who is to get there.
struct NavigationTaskParams {
  double least_way_m = 4.0;  ///< from start to goal, as the crow flies, > 0
  double most_way_m = 15.0;  ///< > least_way_m
};

template <typename Visitor>
void visit_fields(NavigationTaskParams& params, Visitor&& visit) {
  visit("least_way_m", params.least_way_m);
  visit("most_way_m", params.most_way_m);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const NavigationTaskParams& params);

/// A robot in a simulated building that somebody drew, and where it is to go.
struct NavigationTask {
  std::string set;
  std::string kind;  ///< who drew
  Building building;
  Drawing drawing;
  LidarModel lidar;
  Se2 world_from_start;
  Eigen::Vector2d goal_in_world = Eigen::Vector2d::Zero();
  double shortest_m = 0.0;  ///< way in the true building
};

/// Kind `human` or `tps`. The goal is a place that a robot has been driven to.
NavigationTask navigation_task(const std::string& kind, int plan,
                               const NavigationTaskParams& params, double radius_m,
                               std::uint64_t seed);

}  // namespace sketchloc
