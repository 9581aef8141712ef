#include "datasets/sim/detail/distortion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "datasets/sim/detail/row_relaxation.hpp"
#include "motion/check.hpp"

namespace sketchloc::detail {
namespace {

constexpr double kMargin_m = 2.0;  ///< of the lattices around the building
constexpr double kNodeSpacing_m = 0.5;
constexpr double kOutsideWeight = 0.05;  ///< nobody cares for sizes outside the building
constexpr double kLeastRate = 0.12;
constexpr double kPatch_m = 5.0;       ///< longer floors are drawn piece by piece
constexpr int kBendPointsPerSide = 4;  ///< as in [Chen20]
constexpr double kLeastDeterminant = 0.1;

/// A piece of floor that is drawn in a size of its own.
struct Patch {
  PlaneBox box_in_world;
  Eigen::Vector2d log_factor;  ///< of its width and its depth
  Eigen::Vector2d shear;       ///< of its upright and of its level lines
};

Eigen::Vector2d random_log_factor(const Room& room, const DistortionParams& params, Rng& rng) {
  const Eigen::Vector2d size = room.box_in_world.size();
  Eigen::Vector2d factor;
  for (int axis = 0; axis < 2; ++axis) {
    const bool across_corridor = room.use == Room::Use::Corridor && size(axis) <= size(1 - axis);
    factor(axis) = across_corridor
                       ? params.corridor_log_mean + gaussian(params.corridor_log_sigma, rng)
                       : gaussian(params.room_log_sigma, rng);
  }
  return factor;
}

/// One patch per room; long floors are cut along their axes, each piece with its own length.
void append_patches(const Room& room, const DistortionParams& params, std::vector<Patch>& patches,
                    Rng& rng) {
  const PlaneBox& box = room.box_in_world;
  const Eigen::Vector2d common = random_log_factor(room, params, rng);
  std::array<int, 2> pieces{};
  for (int axis = 0; axis < 2; ++axis) {
    pieces[static_cast<std::size_t>(axis)] =
        std::max(1, static_cast<int>(std::lround(box.size()(axis) / kPatch_m)));
  }
  const Eigen::Vector2d piece_m = box.size().cwiseQuotient(Eigen::Vector2d(pieces[0], pieces[1]));
  for (int row = 0; row < pieces[1]; ++row) {
    for (int column = 0; column < pieces[0]; ++column) {
      const Eigen::Vector2d low = box.low + piece_m.cwiseProduct(Eigen::Vector2d(column, row));
      const Eigen::Vector2d own = random_log_factor(room, params, rng);
      const double shear_x = gaussian(params.room_shear_sigma, rng);
      patches.push_back({.box_in_world = {low, low + piece_m},
                         .log_factor = {pieces[0] > 1 ? own.x() : common.x(),
                                        pieces[1] > 1 ? own.y() : common.y()},
                         .shear = {shear_x, gaussian(params.room_shear_sigma, rng)}});
    }
  }
}

const Patch* patch_at(const std::vector<Patch>& patches, const Eigen::Vector2d& point) {
  for (const Patch& patch : patches) {
    if (patch.box_in_world.contains(point)) {
      return &patch;
    }
  }
  return nullptr;
}

/// A straight line that a person means to draw straight.
struct StraightLine {
  Eigen::Vector2d from_in_world;
  Eigen::Vector2d to_in_world;
};

std::vector<StraightLine> straight_lines(const FloorPlan& plan) {
  std::vector<StraightLine> lines;
  for (const Wall& wall : plan.walls) {
    lines.push_back({wall.from_in_world, wall.to_in_world});
  }
  for (const Door& door : plan.doors) {
    lines.push_back({door.from_in_world, door.to_in_world});
  }
  for (const Furniture& item : plan.furniture) {
    const std::vector<Eigen::Vector2d> corners = item.corners_in_world();
    for (std::size_t i = 0; item.structural && i < corners.size(); ++i) {
      lines.push_back({corners[i], corners[(i + 1) % corners.size()]});
    }
  }
  return lines;
}

/// What a person has in mind when drawing: pieces of floor and the lines around them.
struct Floor {
  std::vector<Patch> patches;
  std::vector<StraightLine> lines;
};

/// Where a node of a lattice lies in the world.
using WorldFromNode = std::function<Eigen::Vector2d(const Eigen::Vector2d&)>;

/// Whether a line that runs across the stretched axis passes within a node's reach.
bool on_line_across(const std::vector<StraightLine>& lines, const Eigen::Vector2d& point,
                    int axis) {
  constexpr double kReach_m = 0.3;
  constexpr double kSteepest = 0.3;  // slope of a line that still counts as straight across
  return std::any_of(lines.begin(), lines.end(), [&](const StraightLine& line) {
    const Eigen::Vector2d along = line.to_in_world - line.from_in_world;
    const Eigen::Vector2d offset = point - line.from_in_world;
    const double length = std::abs(along(1 - axis));
    const double share = offset(1 - axis) / (along(1 - axis) == 0.0 ? 1.0 : along(1 - axis));
    const bool across = length > 0.0 && std::abs(along(axis)) < kSteepest * length;
    return across && share > -kReach_m / length && share < 1.0 + kReach_m / length &&
           std::abs(offset(axis) - share * along(axis)) < kReach_m;
  });
}

/// What a person wants of the sizes along one axis: rooms in the sizes that come to mind, walls
/// straight.
StretchWishes wishes_along(int axis, const AxisStretch::Lattice& lattice, const Cell& size,
                           const Floor& floor, const WorldFromNode& world_from_node,
                           const DistortionParams& params) {
  StretchWishes wishes = {.rate = Grid<double>(size.column, size.row, 1.0),
                          .rate_weight = Grid<double>(size.column, size.row, kOutsideWeight),
                          .shear = Grid<double>(size.column, size.row, 0.0),
                          .shear_weight = Grid<double>(size.column, size.row, params.evenness)};
  for (int row = 0; row < size.row; ++row) {
    for (int column = 0; column < size.column; ++column) {
      Eigen::Vector2d node;
      node(axis) = lattice.low.x() + column * lattice.along;
      node(1 - axis) = lattice.low.y() + row * lattice.across;
      const Eigen::Vector2d point_in_world = world_from_node(node);
      if (const Patch* patch = patch_at(floor.patches, point_in_world)) {
        wishes.rate.at({column, row}) = std::exp(patch->log_factor(axis));
        wishes.rate_weight.at({column, row}) = 1.0;
        wishes.shear.at({column, row}) = patch->shear(axis);
      }
      if (on_line_across(floor.lines, point_in_world, axis)) {
        wishes.shear_weight.at({column, row}) = params.straightness;
        wishes.shear.at({column, row}) = 0.0;
      }
    }
  }
  return wishes;
}

AxisStretch stretch_rooms(int axis, const PlaneBox& box, const Floor& floor,
                          const WorldFromNode& world_from_node, const DistortionParams& params) {
  const PlaneBox area = box.grown(kMargin_m);
  const AxisStretch::Lattice lattice = {.axis = axis,
                                        .low = {area.low(axis), area.low(1 - axis)},
                                        .along = kNodeSpacing_m,
                                        .across = kNodeSpacing_m};
  const Cell size = {2 + static_cast<int>(area.size()(axis) / kNodeSpacing_m),
                     2 + static_cast<int>(area.size()(1 - axis) / kNodeSpacing_m)};
  return relax_rows(lattice, wishes_along(axis, lattice, size, floor, world_from_node, params),
                    kLeastRate);
}

/// The box around the image of a box under what is in the chain so far.
PlaneBox image_box(const Deformation& deformation, const PlaneBox& box) {
  constexpr int kSamples = 12;
  PlaneBox image = {deformation(box.low), deformation(box.low)};
  for (int row = 0; row <= kSamples; ++row) {
    for (int column = 0; column <= kSamples; ++column) {
      const Eigen::Vector2d share(column / static_cast<double>(kSamples),
                                  row / static_cast<double>(kSamples));
      const Eigen::Vector2d point = deformation(box.low + share.cwiseProduct(box.size()));
      image.low = image.low.cwiseMin(point);
      image.high = image.high.cwiseMax(point);
    }
  }
  return image;
}

/// A random spline over a regular grid of control points [Chen20]; weaker until it does not fold.
ThinPlateSpline random_bend(const PlaneBox& box, double share, Rng& rng) {
  std::vector<Eigen::Vector2d> points;
  std::vector<Eigen::Vector2d> displacements;
  const double sigma = share * std::sqrt(box.size().prod());
  for (int row = 0; row < kBendPointsPerSide; ++row) {
    for (int column = 0; column < kBendPointsPerSide; ++column) {
      const Eigen::Vector2d at = Eigen::Vector2d(column, row) / (kBendPointsPerSide - 1.0);
      points.push_back(box.low + at.cwiseProduct(box.size()));
      const double x = gaussian(sigma, rng);
      displacements.emplace_back(x, gaussian(sigma, rng));
    }
  }
  const std::optional<TpsSolver> solver = TpsSolver::factor(points);
  check(solver.has_value(), "a grid of control points defines a spline");
  for (double strength = 1.0;; strength *= 0.8) {
    std::vector<Eigen::Vector2d> values = points;
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] += strength * displacements[i];
    }
    ThinPlateSpline bend = solver->solve(values);
    if (find_folds(bend, box.grown(kMargin_m), 40).min_determinant > kLeastDeterminant) {
      return bend;
    }
  }
}

/// Turn, tilt, proportions and scale of the whole drawing.
AffineMap random_layout(const DistortionParams& params, Rng& rng) {
  const double px_per_m = params.px_per_m * std::exp(gaussian(params.px_per_m_log_sigma, rng));
  const double proportion = std::exp(0.5 * gaussian(params.proportion_log_sigma, rng));
  const bool turned = uniform(rng) < params.turned_share;
  const double quarter_turns = std::floor(uniform(1.0, 4.0, rng));
  const double tilt_rad = gaussian(params.tilt_sigma_rad, rng);
  const double angle_rad = (turned ? quarter_turns * std::numbers::pi / 2.0 : 0.0) + tilt_rad;
  Eigen::Matrix2d rotation;
  rotation << std::cos(angle_rad), -std::sin(angle_rad), std::sin(angle_rad), std::cos(angle_rad);
  const Eigen::Vector2d scale(px_per_m * proportion, px_per_m / proportion);
  return {.linear = rotation * scale.asDiagonal()};
}

}  // namespace

Deformation distort(const FloorPlan& plan, const DistortionParams& params, Rng& rng) {
  const PlaneBox box = bounds_in_world(plan);
  Floor floor{.patches = {}, .lines = straight_lines(plan)};
  for (const Room& room : plan.rooms) {
    append_patches(room, params, floor.patches, rng);
  }
  const AxisStretch widths = stretch_rooms(
      0, box, floor, [](const Eigen::Vector2d& node) { return node; }, params);
  Deformation sketch_from_world;
  sketch_from_world.then(widths);
  const AxisStretch depths = stretch_rooms(
      1, image_box(sketch_from_world, box), floor,
      [&](const Eigen::Vector2d& node) { return widths.inverse(node); }, params);
  sketch_from_world.then(depths);
  sketch_from_world.then(random_bend(image_box(sketch_from_world, box), params.bend_share, rng));
  sketch_from_world.then(random_layout(params, rng));
  return sketch_from_world;
}

}  // namespace sketchloc::detail
