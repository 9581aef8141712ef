#include "datasets/sim/drive.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "datasets/sim/detail/polyline.hpp"
#include "datasets/sim/detail/route_planner.hpp"
#include "motion/angles.hpp"
#include "motion/validate.hpp"

namespace sketchloc {
namespace {

using detail::Polyline;
using Points = std::vector<Eigen::Vector2d>;

constexpr double kStep_m = 0.05;         ///< of the driven line
constexpr double kTurnStep_rad = 0.1;    ///< of a turn on the spot
constexpr double kTurnOnSpot_rad = 0.6;  ///< a corner sharper than this is turned on the spot
constexpr double kGoalArea_m = 7.0;
constexpr double kShortestLeg_m = 1.0;
constexpr int kFailuresAllowed = 50;  ///< goals in a row that lead nowhere

double heading_rad(const Eigen::Vector2d& direction) {
  return std::atan2(direction.y(), direction.x());
}

/// Pulls every point towards the middle of its neighbours where the robot still fits.
void smooth(Polyline& line, const detail::RoutePlanner& planner, int rounds) {
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 1; i + 1 < line.size(); ++i) {
      const Eigen::Vector2d candidate = 0.5 * line[i] + 0.25 * (line[i - 1] + line[i + 1]);
      if (planner.fits(candidate)) {
        line[i] = candidate;
      }
    }
  }
}

/// Moves points sideways by slowly changing amounts: nobody drives the same line twice.
void wander(Polyline& line, double sigma_m, const detail::RoutePlanner& planner, Rng& rng) {
  double offset_m = 0.0;
  const Polyline before = line;
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    offset_m = 0.9 * offset_m + gaussian(0.44 * sigma_m, rng);  // stationary sigma = sigma_m
    const Eigen::Vector2d along = (before[i + 1] - before[i - 1]).normalized();
    const Eigen::Vector2d candidate = before[i] + offset_m * Eigen::Vector2d(-along.y(), along.x());
    if (planner.fits(candidate)) {
      line[i] = candidate;
    }
  }
}

/// Follows lines with a robot that drives forward and turns, and notes a pose per scan.
class Driver {
 public:
  Driver(const DriveParams& params, const Eigen::Vector2d& start, double yaw_rad)
      : params_(params), position_(start), yaw_rad_(yaw_rad) {
    note();
  }

  void follow(const Polyline& line) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const std::size_t ahead = std::min(i + 4, line.size() - 1);
      const Eigen::Vector2d direction = line[ahead] - line[i];
      if (direction.norm() > 1e-6) {
        turn_to(heading_rad(direction));
      }
      advance_to(line[i + 1]);
    }
  }

  double way_m() const { return way_m_; }
  MetricTrajectory take() { return std::move(poses_); }

 private:
  void turn_to(double target_rad) {
    const double turn_rad = wrap_rad(target_rad - yaw_rad_);
    const int steps = std::abs(turn_rad) > kTurnOnSpot_rad
                          ? static_cast<int>(std::ceil(std::abs(turn_rad) / kTurnStep_rad))
                          : 1;
    const double share = steps > 1 ? 1.0 / steps : 0.5;  // gentle turns are taken while driving
    for (int step = 0; step < steps; ++step) {
      yaw_rad_ = wrap_rad(yaw_rad_ + share * turn_rad);
      time_s_ += std::abs(share * turn_rad) / params_.turn_rate_radps;
      note_if_due();
    }
  }

  void advance_to(const Eigen::Vector2d& next) {
    const double step_m = (next - position_).norm();
    position_ = next;
    way_m_ += step_m;
    driven_m_ += step_m;
    time_s_ += step_m / params_.speed_mps;
    note_if_due();
  }

  void note_if_due() {
    const double net_turn_rad = std::abs(wrap_rad(yaw_rad_ - noted_yaw_rad_));
    if (driven_m_ >= params_.scan_spacing_m || net_turn_rad >= params_.scan_turn_rad) {
      note();
    }
  }

  void note() {
    poses_.append(time_s_, Se2::from_xy_yaw(position_.x(), position_.y(), yaw_rad_));
    driven_m_ = 0.0;
    noted_yaw_rad_ = yaw_rad_;
  }

  const DriveParams& params_;
  Eigen::Vector2d position_;
  double yaw_rad_;
  double noted_yaw_rad_ = 0.0;
  double time_s_ = 0.0;
  double way_m_ = 0.0;
  double driven_m_ = 0.0;
  MetricTrajectory poses_;
};

/// A room in pieces of at most kGoalArea_m, so that halls are visited as often as they are large.
std::vector<PlaneBox> goal_areas(const PlaneBox& room) {
  const Eigen::Array2d pieces = (room.size() / kGoalArea_m).array().ceil().max(1.0);
  const Eigen::Vector2d piece_m = room.size().array() / pieces;
  std::vector<PlaneBox> areas;
  for (int row = 0; row < static_cast<int>(pieces.y()); ++row) {
    for (int column = 0; column < static_cast<int>(pieces.x()); ++column) {
      const Eigen::Vector2d low = room.low + piece_m.cwiseProduct(Eigen::Vector2d(column, row));
      areas.push_back({low, low + piece_m});
    }
  }
  return areas;
}

/// Where the robot can stand, area by area; areas where it cannot are left out.
std::vector<Points> standing_places(const Building& building, const detail::RoutePlanner& planner) {
  std::vector<Points> by_area;
  for (const Room& room : building.plan.rooms) {
    for (const PlaneBox& area : goal_areas(room.box_in_world)) {
      Points places = planner.standing_places(area);
      if (!places.empty()) {
        by_area.push_back(std::move(places));
      }
    }
  }
  return by_area;
}

const Eigen::Vector2d& pick(const Points& places, Rng& rng) {
  return places[static_cast<std::size_t>(uniform(rng) * static_cast<double>(places.size()))];
}

/// Areas in random order, each as often as any other.
class GoalPicker {
 public:
  explicit GoalPicker(const std::vector<Points>& areas) : areas_(areas) {}

  const Eigen::Vector2d& next(Rng& rng) {
    if (waiting_.empty()) {
      for (std::size_t i = 0; i < areas_.size(); ++i) {
        waiting_.push_back(i);
      }
    }
    const auto chosen =
        static_cast<std::size_t>(uniform(rng) * static_cast<double>(waiting_.size()));
    const std::size_t area = waiting_[chosen];
    waiting_.erase(waiting_.begin() + static_cast<std::ptrdiff_t>(chosen));
    return pick(areas_[area], rng);
  }

 private:
  const std::vector<Points>& areas_;
  std::vector<std::size_t> waiting_;
};

}  // namespace

void validate(const DriveParams& params) {
  require_above("length_m", params.length_m, 0.0);
  require_above("robot_radius_m", params.robot_radius_m, 0.0);
  require_above("scan_spacing_m", params.scan_spacing_m, 0.0);
  require_above("scan_turn_rad", params.scan_turn_rad, 0.0);
  require_above("speed_mps", params.speed_mps, 0.0);
  require_above("turn_rate_radps", params.turn_rate_radps, 0.0);
  require_at_least("wander_m", params.wander_m, 0.0);
}

Drive drive_through(const Building& building, const DriveParams& params, Rng& rng,
                    const std::function<void()>& checkpoint) {
  validate(params);
  const detail::RoutePlanner planner(building.map, params.robot_radius_m);
  const std::vector<Points> areas = standing_places(building, planner);
  if (areas.empty()) {
    return {.status = Drive::Status::NoFreeSpace};
  }
  GoalPicker goals(areas);
  Eigen::Vector2d here = goals.next(rng);
  Driver driver(params, here, uniform(-std::numbers::pi, std::numbers::pi, rng));
  int failures = 0;
  bool way_found = false;  // to one of the goals that failed in a row
  while (driver.way_m() < params.length_m) {
    if (checkpoint) {
      checkpoint();
    }
    const Eigen::Vector2d goal = goals.next(rng);
    std::optional<Polyline> line = planner.route(here, goal);
    if (!line || detail::length(*line) < kShortestLeg_m) {
      way_found = way_found || line;
      if (++failures == kFailuresAllowed) {
        return {.status = way_found ? Drive::Status::Confined : Drive::Status::NoWay};
      }
      continue;
    }
    failures = 0;
    way_found = false;
    smooth(*line, planner, 60);
    wander(*line, params.wander_m, planner, rng);
    smooth(*line, planner, 20);
    driver.follow(detail::resample(*line, kStep_m));
    here = goal;
  }
  return {.status = Drive::Status::Driven, .world_from_robot = driver.take()};
}

}  // namespace sketchloc
