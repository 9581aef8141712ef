#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "eval/navigator.hpp"

namespace sketchloc {

/// The robot at one scan.
struct NavigationFrame {
  Se2 world_from_robot;
  Sim2 sketch_from_robot;                                       ///< as it believes
  std::optional<Eigen::Matrix2d> position_covariance_px2 = {};  ///< in the sketch frame
  double localized_probability = 1.0;
  Navigator::Doing doing = Navigator::Doing::Drives;
  Eigen::Vector2d goal_in_robot = Eigen::Vector2d::Zero();  ///< as it believes, m
  std::vector<Eigen::Vector2d> seen_in_robot = {};          ///< end points of some beams, m
  std::size_t path = 0;                                     ///< of paths_in_sketch
  bool collided = false;
};

/// One drive to one goal.
struct NavigationTrial {
  enum class End {
    Arrived,  ///< so it believed
    Stuck,    ///< no way left
    TooLong
  };
  static constexpr double kCycle_s = 0.5;  ///< from scan to scan

  std::string set;
  std::string kind;
  std::string method;
  End end = End::TooLong;
  double error_m = 0.0;    ///< from the goal where it ended
  double nearest_m = 0.0;  ///< to the goal on the way
  double way_m = 0.0;
  double shortest_m = 0.0;
  int collisions = 0;                 ///< steps that the true building stopped
  int seen_collisions = 0;            ///< of them with something that the LIDAR had seen
  std::vector<double> cycle_ms = {};  ///< by the wall clock
  std::vector<double> cycle_processor_ms = {};
  std::vector<NavigationFrame> frames = {};
  std::vector<PathPoints> paths_in_sketch = {};  ///< planned one after the other, at least one

  bool success(double within_m) const { return end == End::Arrived && error_m <= within_m; }
};

/// What finds the robot.
struct NavigationMethod {
  const LocalizationMethod& method;
  const LocalizationParams& localization;
  WarpPredictor* predictor = nullptr;  ///< of methods that register
};

/// Seconds of any origin.
struct NavigationClock {
  std::function<double()> wall_s;
  std::function<double()> processor_s;  ///< that the calling thread used
};

/// Drives to the goal: scan, find the robot, plan, one step, until it believes to be there.
NavigationTrial navigate(const NavigationTask& task, const NavigationMethod& by,
                         const NavigationParams& params, std::uint64_t seed,
                         const NavigationClock& clock);

}  // namespace sketchloc
