#include "planning/turning_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include "motion/random.hpp"
#include "planning/detail/price_to_go.hpp"

namespace sketchloc {
namespace {

constexpr int kHeadings = 72;      ///< that the search tells apart
constexpr int kFreeHeadings = 16;  ///< that stand for a heading that is not given
constexpr double kCellsPerRadius = 6.0;
constexpr double kMostCell_px = 4.0;
constexpr double kNear_radii = 8.0;            ///< from where the goal is tried by one curve
constexpr std::size_t kMostNodes = 3'000'000;  ///< some 200 MB
constexpr std::size_t kAskTimeEvery = 256;
constexpr double kFullTurn_rad = 2.0 * std::numbers::pi;

std::vector<double> headings_of(const std::optional<double>& given_rad) {
  if (given_rad) {
    return {*given_rad};
  }
  std::vector<double> all;
  for (int i = 0; i < kFreeHeadings; ++i) {
    all.push_back(kFullTurn_rad * i / kFreeHeadings);
  }
  return all;
}

/// How a pose was reached from that of its parent.
struct Node {
  static constexpr std::size_t kNoParent = std::numeric_limits<std::size_t>::max();

  DrawnPose pose;
  double cost_m = 0.0;
  std::size_t parent = kNoParent;
  double curvature_per_px = 0.0;
  bool is_goal = false;  ///< reached by the shortest curve
};

class Search {
 public:
  Search(const FreeSpace& space, const TurningQuery& query)
      : space_(space),
        query_(query),
        shortest_(query.radius_px),
        to_go_m_(detail::price_to_go_m(space, query.goal_in_sketch)),
        cell_px_(std::clamp(query.radius_px / kCellsPerRadius, 1.0, kMostCell_px)),
        step_px_(1.05 * std::max(std::numbers::sqrt2 * cell_px_,
                                 query.radius_px * kFullTurn_rad / kHeadings)),
        columns_(1 + static_cast<std::size_t>(space.width_px() / cell_px_)),
        closed_(columns_ * (1 + static_cast<std::size_t>(space.height_px() / cell_px_)) *
                kHeadings) {
    for (const double heading_rad : headings_of(query.start_heading_rad)) {
      push({.pose = {query.start_in_sketch, heading_rad}});
    }
  }

  TurningSearch run(const TimeIsOver& out_of_time) {
    using Status = TurningSearch::Status;
    for (std::size_t expanded = 0; !open_.empty() && nodes_.size() < kMostNodes;) {
      const std::size_t node = open_.top().node;
      open_.pop();
      if (nodes_[node].is_goal) {
        return {.status = Status::Found, .curve = curve_to(node)};
      }
      const std::size_t cell = cell_of(nodes_[node].pose);
      if (closed_[cell]) {
        continue;
      }
      closed_[cell] = true;
      if (++expanded % kAskTimeEvery == 0 && out_of_time && out_of_time()) {
        return {.status = Status::OutOfTime, .curve = {}};
      }
      expand(node);
    }
    return {};
  }

 private:
  struct Candidate {
    double estimate_m;
    std::size_t node;
    bool operator>(const Candidate& other) const {
      return estimate_m != other.estimate_m ? estimate_m > other.estimate_m : node > other.node;
    }
  };

  std::size_t cell_of(const DrawnPose& pose) const {
    const auto column = static_cast<std::size_t>(pose.place_in_sketch.x() / cell_px_);
    const auto row = static_cast<std::size_t>(pose.place_in_sketch.y() / cell_px_);
    const double turns = pose.heading_rad / kFullTurn_rad;
    const auto heading = static_cast<std::size_t>((turns - std::floor(turns)) * kHeadings);
    return (row * columns_ + column) * kHeadings + std::min<std::size_t>(heading, kHeadings - 1);
  }

  void push(const Node& node) {
    const double to_go_m =
        node.is_goal ? 0.0 : static_cast<double>(to_go_m_.at(cell_at(node.pose.place_in_sketch)));
    if (std::isfinite(to_go_m)) {
      open_.push({node.cost_m + to_go_m, nodes_.size()});
      nodes_.push_back(node);
    }
  }

  /// A way on from a node, if it is free.
  void reach(std::size_t from, const TurningCurve& curve, Node node) {
    const PathPoints places = places_of(curve);
    if (is_free(places, space_)) {
      node.pose = curve.back();
      node.cost_m = nodes_[from].cost_m + cost_m(places, space_);
      node.parent = from;
      push(node);
    }
  }

  void expand(std::size_t node) {
    const DrawnPose pose = nodes_[node].pose;
    for (const double side : {0.0, 1.0, -1.0}) {
      const double curvature_per_px = side / query_.radius_px;
      const TurningCurve curve = arc_from(pose, step_px_, curvature_per_px);
      if (space_.is_free(curve.back().place_in_sketch) && !closed_[cell_of(curve.back())]) {
        reach(node, curve, {.pose = {}, .curvature_per_px = curvature_per_px});
      }
    }
    if ((pose.place_in_sketch - query_.goal_in_sketch).norm() < kNear_radii * query_.radius_px) {
      const DrawnPose goal = nearest_goal(pose);
      reach(node, shortest_.between(pose, goal), {.pose = {}, .is_goal = true});
    }
  }

  DrawnPose nearest_goal(const DrawnPose& from) const {
    DrawnPose nearest;
    double least_px = std::numeric_limits<double>::infinity();
    for (const double heading_rad : headings_of(query_.goal_heading_rad)) {
      const DrawnPose goal{query_.goal_in_sketch, heading_rad};
      const double length_px = shortest_.length_px(from, goal);
      if (length_px < least_px) {
        least_px = length_px;
        nearest = goal;
      }
    }
    return nearest;
  }

  TurningCurve curve_to(std::size_t last) const {
    std::vector<TurningCurve> parts;
    for (std::size_t i = last; nodes_[i].parent != Node::kNoParent; i = nodes_[i].parent) {
      const DrawnPose& from = nodes_[nodes_[i].parent].pose;
      parts.push_back(nodes_[i].is_goal ? shortest_.between(from, nodes_[i].pose)
                                        : arc_from(from, step_px_, nodes_[i].curvature_per_px));
    }
    TurningCurve curve = {parts.back().front()};
    for (auto part = parts.rbegin(); part != parts.rend(); ++part) {
      curve.insert(curve.end(), part->begin() + 1, part->end());
    }
    return curve;
  }

  const FreeSpace& space_;
  const TurningQuery& query_;
  ShortestCurves shortest_;
  Grid<float> to_go_m_;
  double cell_px_;
  double step_px_;  ///< leaves the cell or the heading
  std::size_t columns_;
  std::vector<bool> closed_;
  std::vector<Node> nodes_;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> open_;
};

}  // namespace

TurningSearch search_turning(const FreeSpace& space, const TurningQuery& query,
                             const TimeIsOver& out_of_time) {
  if (!space.is_free(query.start_in_sketch) || !space.is_free(query.goal_in_sketch)) {
    return {};
  }
  return Search(space, query).run(out_of_time);
}

TurningCurve shortened(TurningCurve curve, const FreeSpace& space, const Shortening& by,
                       const TimeIsOver& out_of_time) {
  constexpr std::uint64_t kStream = 1ULL << 33;  // far from those of trees and improver
  Rng rng = make_rng(by.seed, kStream);
  const ShortestCurves shortest(by.radius_px);
  for (int i = 0; i < by.tries && curve.size() > 2 && !(out_of_time && out_of_time()); ++i) {
    const auto pick = [&] {
      return static_cast<std::ptrdiff_t>(uniform(0.0, static_cast<double>(curve.size()), rng));
    };
    const auto [from, to] = std::minmax({pick(), pick()});
    const auto begin = curve.begin() + from;
    const auto end = curve.begin() + to;
    if (to - from < 2) {
      continue;
    }
    const TurningCurve direct = shortest.between(*begin, *end);
    const PathPoints places = places_of(direct);
    const double before_m = cost_m(places_of(TurningCurve(begin, end + 1)), space);
    if (is_free(places, space) && cost_m(places, space) < before_m * (1.0 - 1e-6)) {
      TurningCurve whole(curve.begin(), begin);
      whole.insert(whole.end(), direct.begin(), direct.end());
      whole.insert(whole.end(), end + 1, curve.end());
      curve = std::move(whole);
    }
  }
  return curve;
}

}  // namespace sketchloc
