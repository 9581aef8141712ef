#include "registration/train/sample.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/check.hpp"
#include "motion/validate.hpp"
#include "registration/network_output.hpp"
#include "registration/train/driven_submap.hpp"

namespace sketchloc {
namespace {

/// Scans with their true or measured places, the present one first.
struct Submap {
  Se2 world_from_robot;
  std::vector<PlacedScan> scans;
  std::vector<Scan> owned;  ///< at most one: a scan that is not of the drive
};

Submap draw_lone_scan(const Scene& scene, Rng& rng) {
  const Se2& on_drive = scene.drive()[draw_index(scene.drive().size(), rng)].pose;
  const double yaw_rad = uniform(-std::numbers::pi, std::numbers::pi, rng);
  Submap submap{.world_from_robot = Se2::from_xy_yaw(on_drive.x_m(), on_drive.y_m(), yaw_rad),
                .scans = {},
                .owned = {}};
  submap.owned.push_back(scene.scan(submap.world_from_robot, rng));
  submap.scans.push_back({.scan = submap.owned.data()});
  return submap;
}

/// Goes back along the drive from a random scan, with odometry as good as scan matching makes it.
Submap draw_driven_submap(const Scene& scene, const SampleParams& params, Rng& rng) {
  const std::size_t present = draw_index(scene.scans().size(), rng);
  const DrivenSubmapParams submap{.max_scans = params.max_scans,
                                  .scan_spacing_m = params.scan_spacing_m,
                                  .noise = params.submap_noise};
  return {.world_from_robot = scene.drive()[present].pose,
          .scans = draw_driven_submap(scene.drive(), scene.scans(), present, submap, rng),
          .owned = {}};
}

Submap draw_submap(const Scene& scene, const SampleParams& params, Rng& rng) {
  return uniform(rng) < params.alone_share ? draw_lone_scan(scene, rng)
                                           : draw_driven_submap(scene, params, rng);
}

/// A prior from which a network has looked once or twice.
Sim2 improved(const Sim2& prior, const std::vector<PlacedScan>& scans, const SketchCropper& sketch,
              const ImprovingNetworks& networks, Rng& rng) {
  WarpPredictor& network = draw_index(2, rng) == 0 ? *networks.once : *networks.twice;
  const auto found = network.predict(scans, sketch, {&prior, 1}).front();
  return found ? found->sketch_from_robot : prior;
}

/// Priors that know nothing: anywhere on the drive, headed anywhere.
std::vector<Sim2> draw_priors_elsewhere(const Scene& scene, const SampleParams& params, Rng& rng) {
  std::vector<Sim2> priors;
  for (int i = 0; i < params.registered.elsewhere_priors; ++i) {
    const Se2& on_drive = scene.drive()[draw_index(scene.drive().size(), rng)].pose;
    const Se2 there = Se2::from_xy_yaw(on_drive.x_m(), on_drive.y_m(),
                                       uniform(-std::numbers::pi, std::numbers::pi, rng));
    priors.push_back(
        draw_prior(scene.sketch_from_world().exact().sketch_from_robot(there), params.prior, rng));
  }
  return priors;
}

/// The prior from which one look promises most, by what the network says of being right.
const Sim2& most_promising(const std::vector<Sim2>& priors, const std::vector<PlacedScan>& scans,
                           const SketchCropper& sketch, WarpPredictor& once) {
  const auto found = once.predict(scans, sketch, priors);
  const auto promise = [](const std::optional<Registration>& one) {
    return one ? one->inlier_probability : -1.0;
  };
  const auto best = std::ranges::max_element(found, {}, promise);
  return priors[static_cast<std::size_t>(best - found.begin())];
}

template <std::size_t kSize>
void set_point(std::array<float, kSize>& values, std::size_t index, const Eigen::Vector2d& point) {
  values[2 * index] = static_cast<float>(point.x());
  values[2 * index + 1] = static_cast<float>(point.y());
}

void label_warp(Sample& sample, const Scene& scene, const Se2& world_from_robot) {
  const Sim2 prior_from_sketch = sample.prior_sketch_from_robot.inverse();
  const double unit = unit_m(sample.window);
  const auto shift = [&](const Eigen::Vector2d& point_in_robot) -> Eigen::Vector2d {
    const Eigen::Vector2d drawn = scene.sketch_from_world()(world_from_robot * point_in_robot);
    return (prior_from_sketch * drawn - point_in_robot) / unit;
  };
  const std::vector<Eigen::Vector2d> controls = control_points_in_robot(sample.window);
  for (std::size_t i = 0; i < controls.size(); ++i) {
    set_point(sample.control_shift, i, shift(controls[i]));
  }
  const std::vector<Eigen::Vector2d> grid = grid_points_in_robot(sample.window);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    if (scene.indoors(world_from_robot * grid[i])) {
      set_point(sample.grid_shift, i, shift(grid[i]));
      sample.grid_weight[i] = 1.0F;
    }
  }
}

void label_pose(Sample& sample) {
  const Sim2 prior_from_robot = sample.prior_sketch_from_robot.inverse() * sample.sketch_from_robot;
  const double unit = unit_m(sample.window);
  sample.pose = {static_cast<float>(prior_from_robot.x() / unit),
                 static_cast<float>(prior_from_robot.y() / unit),
                 static_cast<float>(prior_from_robot.yaw_rad()),
                 static_cast<float>(std::log(prior_from_robot.scale()))};
}

/// Backwards, as [Chen20] has it: the crop's points in the world, seen from the robot.
void label_published_warp(Sample& sample, const Scene& scene, const Se2& world_from_robot) {
  const Eigen::Vector2d centre_in_sketch = sample.prior_sketch_from_robot.translation();
  const std::vector<Eigen::Vector2d> targets =
      square_lattice(kControlsPerSide, published_crop_side_px(sample.window), centre_in_sketch);
  const Se2 robot_from_world = world_from_robot.inverse();
  const Sim2 robot_from_sketch = sample.sketch_from_robot.inverse();
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const Eigen::Vector2d guess = world_from_robot * (robot_from_sketch * targets[i]);
    const Eigen::Vector2d drawn_here = scene.sketch_from_world().inverse(targets[i], guess).point;
    set_point(sample.published_source, i,
              2.0 / sample.window.side_m * (robot_from_world * drawn_here));
  }
}

}  // namespace

void validate(const PriorError& error) {
  require_at_least("max_shift_m", error.max_shift_m, 0.0);
  require_in_range("max_turn_rad", error.max_turn_rad, 0.0, std::numbers::pi);
  require_at_least("log_scale_sigma", error.log_scale_sigma, 0.0);
  require_in_range("full_share", error.full_share, 0.0, 1.0);
  require_in_range("least_size", error.least_size, 1e-6, 1.0);
  require_in_range("improved_share", error.improved_share, 0.0, 1.0);
}

void validate(const RegisteredParams& params) {
  require_in_range("elsewhere_share", params.elsewhere_share, 0.0, 1.0);
  require_in_range("elsewhere_priors", params.elsewhere_priors, 1, 64);
}

void validate(const SampleParams& params) {
  require_at_least("cells", params.cells, 16.0);
  validate(params.window());
  require_above("min_fine_side_m", params.min_fine_side_m, 0.0);
  require_at_least("max_fine_side_m", params.max_fine_side_m, params.min_fine_side_m);
  require_in_range("alone_share", params.alone_share, 0.0, 1.0);
  require_at_least("max_scans", params.max_scans, 1.0);
  require_at_least("scan_spacing_m", params.scan_spacing_m, 0.0);
  validate(params.submap_noise);
  validate(params.prior);
  validate(params.registered);
}

std::vector<Eigen::Vector2d> control_points_in_robot(const LocalWindow& window) {
  return square_lattice(kControlsPerSide, window.side_m, window.centre_in_robot());
}

std::vector<Eigen::Vector2d> grid_points_in_robot(const LocalWindow& window) {
  const double side_m = window.side_m * (kGridPerSide - 1) / kGridPerSide;
  return square_lattice(kGridPerSide, side_m, window.centre_in_robot());
}

Sim2 draw_prior(const Sim2& sketch_from_robot, const PriorError& error, Rng& rng) {
  const bool full = uniform(rng) < error.full_share;
  const double size = full ? 1.0 : std::pow(error.least_size, uniform(rng));
  const double shift_m = size * error.max_shift_m * std::sqrt(uniform(rng));
  const double direction_rad = uniform(-std::numbers::pi, std::numbers::pi, rng);
  const double turn_rad = size * uniform(-error.max_turn_rad, error.max_turn_rad, rng);
  const double log_scale = size * gaussian(error.log_scale_sigma, rng);
  return sketch_from_robot * Sim2::from_xy_yaw_scale(shift_m * std::cos(direction_rad),
                                                     shift_m * std::sin(direction_rad), turn_rad,
                                                     std::exp(log_scale));
}

Sample draw_sample(const Scene& scene, const SampleParams& params, InputKind kind, Rng& rng,
                   const ImprovingNetworks& networks) {
  const Submap submap = draw_submap(scene, params, rng);
  Sample sample;
  sample.sketch_from_robot =
      scene.sketch_from_world().exact().sketch_from_robot(submap.world_from_robot);
  sample.prior_sketch_from_robot = draw_prior(sample.sketch_from_robot, params.prior, rng);
  sample.window = params.window();
  if (networks.once != nullptr && uniform(rng) < params.prior.improved_share) {
    sample.prior_sketch_from_robot =
        improved(sample.prior_sketch_from_robot, submap.scans, scene.sketch(), networks, rng);
    sample.window.side_m = params.min_fine_side_m *
                           std::pow(params.max_fine_side_m / params.min_fine_side_m, uniform(rng));
  }
  sample.input = network_input(kind, submap.scans, scene.sketch(), sample.prior_sketch_from_robot,
                               sample.window);
  label_pose(sample);
  if (kind == InputKind::Published) {
    label_published_warp(sample, scene, submap.world_from_robot);
  } else {
    label_warp(sample, scene, submap.world_from_robot);
  }
  return sample;
}

Sample draw_registered(const Scene& scene, const SampleParams& params, Rng& rng,
                       const ImprovingNetworks& networks) {
  check(networks.once != nullptr && networks.twice != nullptr, "networks that register");
  const Submap submap = draw_submap(scene, params, rng);
  Sample sample;
  sample.sketch_from_robot =
      scene.sketch_from_world().exact().sketch_from_robot(submap.world_from_robot);
  sample.window = params.window();
  Sim2 prior = draw_prior(sample.sketch_from_robot, params.prior, rng);
  if (uniform(rng) < params.registered.elsewhere_share) {
    const std::vector<Sim2> priors = draw_priors_elsewhere(scene, params, rng);
    prior = most_promising(priors, submap.scans, scene.sketch(), *networks.once);
  }
  const auto found = networks.twice->predict(submap.scans, scene.sketch(), {&prior, 1}).front();
  sample.prior_sketch_from_robot = found ? found->sketch_from_robot : prior;
  sample.input = network_input(InputKind::Residual, submap.scans, scene.sketch(),
                               sample.prior_sketch_from_robot, sample.window);
  label_pose(sample);
  return sample;
}

}  // namespace sketchloc
