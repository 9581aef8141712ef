#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "datasets/reference.hpp"
#include "datasets/run.hpp"
#include "datasets/sim/data_set.hpp"
#include "datasets/sketch.hpp"
#include "registration/recent_scans.hpp"
#include "registration/sketch_crop.hpp"

namespace sketchloc {

/// One question to a registration method: where in the drawing is this?
struct RegistrationStep {
  std::size_t step = 0;              ///< of the run
  Sim2 sketch_from_robot;            ///< the answer
  Se2 odom_from_robot;               ///< matched odometry
  std::vector<Scan> scans;           ///< the present one first, then back in time
  std::vector<Se2> robot_from_then;  ///< the robot's pose at each of them

  /// A view on the scans; valid as long as the step stays where it is.
  std::vector<PlacedScan> submap() const;
};

/// A drive in a drawing as questions.
struct RegistrationSet {
  std::string name;
  std::string kind;  ///< sets of one kind share a row of the results: "tps", "human" ...
  Sketch sketch;
  SketchCropper drawing;
  std::vector<RegistrationStep> steps;
  /// Where each place of the world was drawn; none where people only know it here and there.
  std::optional<Deformation> sketch_from_world = {};
  std::vector<Se2> world_from_robot = {};  ///< of each of `steps`, with sketch_from_world
};

struct RegistrationSetParams {
  double step_spacing_m = 0.5;  ///< way between questions, >= 0
  RecentScansParams recent;
};

template <typename Visitor>
void visit_fields(RegistrationSetParams& params, Visitor&& visit) {
  visit("step_spacing_m", params.step_spacing_m);
  visit("recent", params.recent);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const RegistrationSetParams& params);

/// The scored poses of a run; its odometry is refined by scan matching first.
RegistrationSet make_registration_set(std::string name, std::string kind, Sketch sketch,
                                      const Run& run, const Reference& reference,
                                      const RegistrationSetParams& params = {});

/// The same of a simulated run, whose truth is known everywhere.
RegistrationSet make_registration_set(std::string name, std::string kind, const DataSet& data_set,
                                      const RegistrationSetParams& params = {});

/// How far off a pose is.
struct RegistrationError {
  double position_m = 0.0;   ///< in the true world; else by the reference's local scale
  double heading_rad = 0.0;  ///< in [0, pi]
};

/// The error of a pose at steps[index]. Where the world is known, the pose is mapped back to it:
/// its position by the inverse of the deformation, its heading by the rotation there.
RegistrationError registration_error(const RegistrationSet& set, std::size_t index,
                                     const Sim2& sketch_from_robot);

}  // namespace sketchloc
