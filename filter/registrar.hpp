#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "datasets/scan.hpp"
#include "datasets/sketch.hpp"
#include "filter/estimate.hpp"
#include "filter/mode_finder.hpp"
#include "filter/particle_set.hpp"
#include "filter/pose_likelihood.hpp"
#include "filter/predict.hpp"
#include "motion/se2.hpp"
#include "registration/recent_scans.hpp"
#include "registration/sketch_crop.hpp"
#include "registration/warp_predictor.hpp"

namespace sketchloc {

/// What the filter does with registrations; only where it is given a predictor.
struct FusionParams {
  bool propose = true;    ///< they tell where the particles may be
  bool measure = true;    ///< they unbend the scan, which is scored beside the scan as it is
  double way_m = 0.4;     ///< between registrations, > 0
  double turn_rad = 0.5;  ///< or turned by this much, > 0
  double independent_way_m =
      1.0;  ///< way after which a registration knows nothing of the last, > 0
  double independent_turn_rad = 3.0;  ///< or turned by this much, > 0
  int max_modes = 2;                  ///< registered, the heaviest ones, in [1, 16]
  PoseTrust trust{};
  RecentScansParams recent{};  ///< what is registered
};

template <typename Visitor>
void visit_fields(FusionParams& fusion, Visitor&& visit) {
  visit("propose", fusion.propose);
  visit("measure", fusion.measure);
  visit("way_m", fusion.way_m);
  visit("turn_rad", fusion.turn_rad);
  visit("independent_way_m", fusion.independent_way_m);
  visit("independent_turn_rad", fusion.independent_turn_rad);
  visit("max_modes", fusion.max_modes);
  visit("trust", fusion.trust);
  visit("recent", fusion.recent);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const FusionParams& fusion);

/// Registers the scans of the last metres from where the filter believes the robot to be.
class Registrar {
 public:
  /// The predictor must outlive the registrar.
  Registrar(const Sketch& sketch, WarpPredictor& predictor, const FusionParams& params);

  /// A new run.
  void forget();

  /// What it knows between two scans.
  void save(StateWriter& state) const;
  void load(StateReader& state);

  /// Takes the present scan, with the odometry at its instant.
  void add(const Scan& scan, const Se2& odom_from_robot, const Se2& last_from_robot);

  /// Whether the robot has moved enough since the last registration, and the scan saw anything.
  bool is_due() const;

  /// Registers from each mode's pose, moved by what the robot did since; the heaviest ones only.
  void look(std::span<const Mode> modes, const Se2& then_from_robot);

  /// Of the last look; modes without a registration that says how sure it is are left out.
  std::span<const Registration> registrations() const { return registrations_; }
  std::span<const PoseLikelihood> likelihoods() const { return likelihoods_; }

  /// Registers the present scans from any other poses; not a look at the modes.
  std::vector<std::optional<Registration>> register_from(std::span<const Sim2> priors) const {
    return predictor_->predict(recent_.placed(), cropper_, priors);
  }

  /// Whether there is anything to register.
  bool sees_anything() const { return saw_anything_; }

  /// The index of each particle's likelihood, by the mode that it belonged to before it moved.
  void assign(const ParticleSet& particles, const ModeParams& modes,
              std::vector<std::int8_t>& likelihood_of) const;

 private:
  FusionParams params_;
  WarpPredictor* predictor_;
  SketchCropper cropper_;
  RecentScans recent_;
  bool saw_anything_ = false;
  bool looked_once_ = false;
  double way_since_m_ = 0.0;
  double turn_since_rad_ = 0.0;
  std::vector<Sim2> modes_;  ///< of the registrations, before the robot's last step
  std::vector<Registration> registrations_;
  std::vector<PoseLikelihood> likelihoods_;
};

}  // namespace sketchloc
