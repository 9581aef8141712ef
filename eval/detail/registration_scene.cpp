#include "eval/detail/registration_scene.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "eval/detail/scan_marks.hpp"
#include "eval/detail/text.hpp"
#include "motion/check.hpp"

namespace sketchloc::detail {
namespace {

using Mark = SceneLayer::Mark;
using Points = std::vector<Eigen::Vector2d>;

constexpr Colour kPrior = kGrey;
constexpr Colour kPriorDots{178, 182, 192};
constexpr Colour kEstimate = kBad;
constexpr Colour kFloor{86, 180, 233};  // sky blue of [Okabe08]
constexpr int kSquaresPerSide = 8;
constexpr double kSample = 20.0;  ///< length of what stands before a text of the legend

/// End points of the submap in the window, in the robot frame.
Points points_in_window(const RegistrationView& view) {
  const Sim2 cells_from_robot = view.window.cells_from_robot();
  const PlaneBox cells{.low = Eigen::Vector2d::Zero(),
                       .high = Eigen::Vector2d::Constant(view.window.cells)};
  Points points;
  for (const PlacedScan& placed : view.submap) {
    for (const Eigen::Vector2d& seen : end_points_in_robot(*placed.scan)) {
      const Eigen::Vector2d point = placed.robot_from_then * seen;
      if (cells.contains(cells_from_robot * point)) {
        points.push_back(point);
      }
    }
  }
  return points;
}

/// Where a point of the robot's plane lies in the drawing by the warp.
std::optional<Eigen::Vector2d> bent(const Warp& warp, const Eigen::Vector2d& point_in_robot) {
  const std::optional<PlaneMapPoint> there = warp.sketch_from_robot(point_in_robot);
  return there && there->value.allFinite() ? std::optional(there->value) : std::nullopt;
}

Points bent(const Warp& warp, const Points& points_in_robot) {
  Points places;
  for (const Eigen::Vector2d& point : points_in_robot) {
    if (const auto place = bent(warp, point)) {
      places.push_back(*place);
    }
  }
  return places;
}

Points placed_by(const Sim2& sketch_from_robot, const Points& points_in_robot) {
  Points places;
  for (const Eigen::Vector2d& point : points_in_robot) {
    places.push_back(sketch_from_robot * point);
  }
  return places;
}

/// The lines of the robot's plane that stand at a number of squares from the window's side, both
/// those along x and those along y; cut where the warp has no value.
std::vector<Polyline> bent_lines(const Warp& warp, const LocalWindow& window, int square) {
  constexpr int kPointsPerSide = 4 * kSquaresPerSide;
  const Eigen::Vector2d corner =
      window.centre_in_robot() - Eigen::Vector2d::Constant(0.5 * window.side_m);
  const double across = window.side_m * square / kSquaresPerSide;
  std::vector<Polyline> lines;
  for (const int axis : {0, 1}) {
    bool goes_on = false;
    for (int i = 0; i <= kPointsPerSide; ++i) {
      Eigen::Vector2d point = corner;
      point[axis] += across;
      point[1 - axis] += window.side_m * i / kPointsPerSide;
      const auto place = bent(warp, point);
      if (place && !goes_on) {
        lines.emplace_back();
      }
      if (place) {
        lines.back().push_back(*place);
      }
      goes_on = place.has_value();
    }
  }
  return lines;
}

/// The ellipse that holds the position with 95 %, where the covariance is known.
std::vector<Polyline> ellipse(const Registration& registration) {
  constexpr double kChiSquared95 = 5.991;  // 2 degrees of freedom
  constexpr int kCorners = 48;
  if (!registration.covariance || !registration.covariance->allFinite()) {
    return {};
  }
  const Eigen::Matrix2d covariance = registration.covariance->topLeftCorner<2, 2>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance);
  const Eigen::Vector2d lengths = (kChiSquared95 * axes.eigenvalues().cwiseMax(0.0)).cwiseSqrt();
  Polyline line;
  for (int i = 0; i <= kCorners; ++i) {
    const double angle_rad = 2.0 * std::numbers::pi * i / kCorners;
    const Eigen::Vector2d on_circle(std::cos(angle_rad), std::sin(angle_rad));
    line.push_back(registration.sketch_from_robot *
                   Eigen::Vector2d(axes.eigenvectors() * lengths.cwiseProduct(on_circle)));
  }
  return {line};
}

/// A square that holds what is near enough to the prior to be shown with it.
class GrowingView {
 public:
  explicit GrowingView(const RegistrationView& view)
      : centre_(view.prior_sketch_from_robot * view.window.centre_in_robot()),
        window_px_(view.window.side_m * view.prior_sketch_from_robot.scale()),
        low_(Eigen::Array2d::Constant(-0.3 * window_px_)),
        high_(Eigen::Array2d::Constant(0.3 * window_px_)) {}

  /// At most so many sides of the window away.
  void add(const Eigen::Vector2d& place, double farthest) {
    const Eigen::Array2d offset =
        (place - centre_).array().max(-farthest * window_px_).min(farthest * window_px_);
    low_ = low_.min(offset);
    high_ = high_.max(offset);
  }

  View square() const {
    constexpr double kMargin = 1.06;
    const Eigen::Vector2d middle = centre_ + Eigen::Vector2d(0.5 * (low_ + high_));
    const Eigen::Vector2d half =
        Eigen::Vector2d::Constant(0.5 * kMargin * (high_ - low_).maxCoeff());
    return {.low = middle - half, .high = middle + half};
  }

 private:
  Eigen::Vector2d centre_;
  double window_px_;
  Eigen::Array2d low_;
  Eigen::Array2d high_;
};

bool contains(const View& view, const Eigen::Vector2d& place) {
  return PlaneBox{.low = view.low, .high = view.high}.contains(place);
}

/// One dot for all that would lie on each other, at most so many.
Polyline thinned(const Points& places, const View& view) {
  constexpr std::size_t kMost = 1000;
  for (double spacing = view.width() / PictureSizes::kSide;; spacing *= 1.5) {
    std::set<std::pair<int, int>> taken;
    Polyline kept;
    for (const Eigen::Vector2d& place : places) {
      if (contains(view, place)) {
        const Eigen::Vector2i cell = ((place - view.low) / spacing).cast<int>();
        if (taken.insert({cell.x(), cell.y()}).second) {
          kept.push_back(place);
        }
      }
    }
    if (kept.size() <= kMost) {
      return kept;
    }
  }
}

/// The parts of lines that are not far outside of the view.
std::vector<Polyline> near_view(const std::vector<Polyline>& lines, const View& view) {
  const Eigen::Vector2d beyond = Eigen::Vector2d::Constant(view.width());
  const View wider{.low = view.low - beyond, .high = view.high + beyond};
  std::vector<Polyline> parts;
  for (const Polyline& line : lines) {
    bool goes_on = false;
    for (const Eigen::Vector2d& point : line) {
      const bool near = contains(wider, point);
      if (near && !goes_on) {
        parts.emplace_back();
      }
      if (near) {
        parts.back().push_back(point);
      }
      goes_on = near;
    }
  }
  return parts;
}

/// A short piece of a layer, to the right from a point.
SceneLayer sample_of(const SceneLayer& layer, const Eigen::Vector2d& from) {
  constexpr double kHalf = 6.0;
  SceneLayer sample = layer;
  const auto at = [&](double x, double y) -> Eigen::Vector2d {
    return from + Eigen::Vector2d(x, y);
  };
  switch (layer.mark) {
    case Mark::Lines:
      sample.look.lines = {{at(0.0, 0.0), at(kSample, 0.0)}};
      break;
    case Mark::Dots:
      sample.look.lines = {{at(2.0, -1.0), at(7.0, 1.0), at(12.0, -1.0), at(17.0, 1.0)}};
      break;
    case Mark::Robot:
    case Mark::Outline:
      sample.look.lines = {{at(17.0, 0.0), at(4.0, kHalf), at(4.0, -kHalf)}};
      break;
  }
  return sample;
}

/// What the named layers are, in lines below the square.
void add_legend(RegistrationScene& scene) {
  constexpr double kLetter = 0.6 * PictureSizes::kText;  // wide enough for most fonts
  constexpr double kMargin = PictureSizes::kMargin;
  Eigen::Vector2d at(kMargin, -PictureSizes::kLine);
  for (const SceneLayer& layer : scene.layers) {
    if (layer.look.name.empty()) {
      continue;
    }
    const double text_width = kLetter * static_cast<double>(layer.look.name.size());
    if (at.x() > kMargin && at.x() + kSample + kMargin + text_width > PictureSizes::kSide) {
      at = {kMargin, at.y() - PictureSizes::kLine};
    }
    scene.samples.push_back(sample_of(layer, at));
    at.x() += kSample + kMargin;
    scene.texts.push_back(
        {.text = layer.look.name, .at = at - Eigen::Vector2d(0.0, 0.35 * PictureSizes::kText)});
    at.x() += text_width + kMargin;
  }
  scene.legend_height = PictureSizes::kLine - at.y();
}

/// Fills a scene from below.
class SceneBuilder {
 public:
  explicit SceneBuilder(const View& view) { scene_.view = view; }

  void add_dots(const std::string& name, const Colour& colour, const Points& places) {
    constexpr double kDot = 2.6;
    const Polyline dots = thinned(places, scene_.view);
    if (!dots.empty()) {
      add(Mark::Dots, {.name = name, .colour = colour, .width = kDot, .lines = {dots}});
    }
  }
  void add_lines(const std::string& name, const Colour& colour, double width,
                 const std::vector<Polyline>& lines) {
    const std::vector<Polyline> parts = near_view(lines, scene_.view);
    add(Mark::Lines, {.name = name, .colour = colour, .width = width, .lines = parts});
  }
  void add_robot(Mark mark, const std::string& name, const Colour& colour,
                 const Sim2& sketch_from_robot) {
    constexpr double kSize = 0.036;  // of the view
    const bool shown = contains(scene_.view, sketch_from_robot.translation());
    PathLayer look{.name = shown ? name : name + " (outside of the picture)", .colour = colour};
    if (shown) {
      look.lines = {robot_outline(sketch_from_robot,
                                  kSize * scene_.view.width() / sketch_from_robot.scale())};
    }
    add(mark, look);
  }
  void write(const std::string& text) {
    constexpr double kMargin = PictureSizes::kMargin;
    scene_.texts.push_back(
        {.text = text, .at = {kMargin, PictureSizes::kSide - PictureSizes::kText - kMargin}});
  }
  RegistrationScene take() {
    add_legend(scene_);
    return std::move(scene_);
  }

 private:
  void add(Mark mark, PathLayer look) {
    const double zoom = PictureSizes::kSide / scene_.view.width();
    for (Polyline& line : look.lines) {
      for (Eigen::Vector2d& point : line) {
        point = zoom * (point - scene_.view.low);
      }
    }
    scene_.layers.push_back({.mark = mark, .look = std::move(look)});
  }

  RegistrationScene scene_;
};

View view_of(const RegistrationView& view, const Points& at_prior, const Points& by_warp) {
  constexpr double kBent = 0.75;
  constexpr double kPoses = 2.0;
  GrowingView shown(view);
  for (const Points* places : {&at_prior, &by_warp}) {
    for (const Eigen::Vector2d& place : *places) {
      shown.add(place, kBent);
    }
  }
  for (const auto& pose :
       {std::optional(view.prior_sketch_from_robot), view.true_sketch_from_robot,
        view.registration != nullptr ? std::optional(view.registration->sketch_from_robot)
                                     : std::nullopt}) {
    if (pose) {
      shown.add(pose->translation(), kPoses);
    }
  }
  return shown.square();
}

/// The robot's plane in squares, as the warp bends it.
void add_floor(SceneBuilder& scene, const RegistrationView& view) {
  constexpr double kThin = 0.7;
  constexpr double kBorder = 1.8;
  const Warp& warp = view.registration->warp;
  for (int square = 1; square < kSquaresPerSide; ++square) {
    scene.add_lines("", kFloor, kThin, bent_lines(warp, view.window, square));
  }
  std::vector<Polyline> border = bent_lines(warp, view.window, 0);
  std::ranges::move(bent_lines(warp, view.window, kSquaresPerSide), std::back_inserter(border));
  scene.add_lines("floor around the robot in squares of " +
                      short_number(view.window.side_m / kSquaresPerSide) + " m, bent as drawn",
                  kFloor, kBorder, border);
}

void add_estimate(SceneBuilder& scene, const Registration& registration) {
  constexpr double kEllipse = 1.8;
  scene.add_robot(Mark::Robot, "estimate", kEstimate, registration.sketch_from_robot);
  if (const auto line = ellipse(registration); !line.empty()) {
    scene.add_lines("where it is with 95 %", kEstimate, kEllipse, line);
  }
}

}  // namespace

RegistrationScene make_registration_scene(const RegistrationView& view) {
  check(view.sketch != nullptr, "a registration is shown on a drawing");
  const Points in_robot = points_in_window(view);
  const Points at_prior = placed_by(view.prior_sketch_from_robot, in_robot);
  const Points by_warp =
      view.registration != nullptr ? bent(view.registration->warp, in_robot) : Points{};
  SceneBuilder scene(view_of(view, at_prior, by_warp));
  if (view.registration != nullptr) {
    add_floor(scene, view);
  }
  scene.add_dots("scan at the prior", kPriorDots, at_prior);
  scene.add_dots("scan, bent alike", kEstimate, by_warp);
  scene.add_robot(Mark::Robot, "prior", kPrior, view.prior_sketch_from_robot);
  if (view.registration != nullptr) {
    add_estimate(scene, *view.registration);
  } else {
    scene.write("no registration found");
  }
  if (view.true_sketch_from_robot) {  // hollow: it may lie on the estimate
    scene.add_robot(Mark::Outline, "reference", kReferenceBlue, *view.true_sketch_from_robot);
  }
  return scene.take();
}

PaperExcerpt drawing_of(const RegistrationScene& scene, const Sketch& sketch) {
  constexpr std::uint8_t kInk = 90;  // darker than under paths: dots lie on it
  return paper_excerpt(sketch, scene.view, kInk);
}

}  // namespace sketchloc::detail
