#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "datasets/scan.hpp"
#include "datasets/sketch.hpp"
#include "filter/challengers.hpp"
#include "filter/global_sampler.hpp"
#include "filter/localized_belief.hpp"
#include "filter/localizer_params.hpp"
#include "filter/mode_finder.hpp"
#include "filter/particle_set.hpp"
#include "filter/predict.hpp"
#include "filter/recovery.hpp"
#include "filter/registrar.hpp"
#include "filter/resampler.hpp"
#include "filter/scan_model.hpp"
#include "filter/step_report.hpp"
#include "motion/odometry.hpp"
#include "motion/se2.hpp"

namespace sketchloc {

/// What a step may cost; where time is short, it can do with less.
struct StepBudget {
  std::size_t max_particles = std::numeric_limits<std::size_t>::max();  ///< >= 1
  bool may_register = true;
};

/// Whether the filter could start with nothing known.
enum class GlobalStart {
  Started,
  NoFreeSpace,  ///< the drawing encloses no free space to start in
  NoReturns     ///< the scan saw nothing, so that it does not tell the scale
};

/// Monte Carlo localization in a drawing: one step per scan, online. Works in the odometry it is
/// given: refine wheel odometry first (registration/matched_odometry.hpp).
class Localizer {
 public:
  /// With a predictor, which must outlive the localizer, registrations help. Throws
  /// std::invalid_argument if a parameter is out of range.
  Localizer(const Sketch& sketch, const LocalizerParams& params,
            WarpPredictor* predictor = nullptr);

  /// Starts at a known pose.
  void start_at(const Sim2& sketch_from_robot);

  /// Starts with nothing known. The scan, the first one that saw anything, tells the scale; the
  /// filter is started only if the result says so.
  GlobalStart start_anywhere(const Scan& first_scan);

  /// Takes the next scan with the odometry at its instant. The report is valid until the next call.
  const StepReport& step(const Scan& scan, const Se2& odom_from_robot,
                         const StepBudget& budget = {});

  /// The robot may have moved while nobody measured it: every pose gets this much noise, 1-sigma.
  void spread(double position_m, double heading_rad);

  /// All that the steps to come depend on, exactly: one with the same drawing and parameters that
  /// loads it goes on with the same bytes. Where load throws, start it anew.
  void save(StateWriter& state) const;
  void load(StateReader& state);

  Localizer(const Localizer&) = delete;  // the model refers to the table
  Localizer& operator=(const Localizer&) = delete;

  const ParticleSet& particles() const { return particles_; }

 private:
  void forget();
  void predict_all(const Se2& robot_from_next);
  double weight_asked_about() const;
  bool look(const Se2& robot_from_next, const StepBudget& budget);
  void weigh(std::size_t beams);
  void resample(const StepBudget& budget);
  void shrink(std::size_t most);
  void recover();
  void draw_candidates();
  bool gate_opens() const;
  double new_share() const;
  void draw_around(const Sim2& sketch_from_robot, ParticleSet& particles,
                   const ParticleRange& range, Rng& rng) const;
  void believe(const std::optional<Sim2>& expected_sketch_from_robot, const Se2& robot_from_next,
               const StepBudget& budget);
  void follow_jump(const Sim2& expected_sketch_from_robot);
  void compare_scans(const Scan& scan, const Se2& robot_from_next);
  void hear_registrations();
  void challenge(const Se2& robot_from_next, const StepBudget& budget);
  void ask(std::vector<Challenger> asked);
  void take_over();

  LocalizerParams params_;
  RangeTable table_;
  GlobalSampler anywhere_;
  ScanModel model_;
  ModeFinder mode_finder_;
  EvidenceMonitor evidence_;
  LocalizedBelief belief_;
  bool established_ = false;  ///< the tracked pose was given, or has proved itself
  Challengers challengers_;
  std::optional<Registrar> registrar_;
  Resampler resampler_;

  ParticleSet particles_;
  ParticleSet candidates_;             ///< for recovery
  std::vector<std::uint32_t> chosen_;  ///< of the candidates
  std::vector<float> scores_;
  std::vector<std::int8_t> likelihood_of_;

  std::optional<double> log_px_per_m_;  ///< of a map with a known scale
  std::optional<Se2> last_odom_from_robot_;
  std::size_t steps_ = 0;
  double way_since_update_m_ = 0.0;
  double turn_since_update_rad_ = 0.0;
  bool updated_once_ = false;
  double update_share_ = 1.0;  ///< how much of the last update's scan was new
  double way_since_signs_m_ = 0.0;
  Scan last_scan_;  ///< that saw anything, and where it was since
  std::optional<Se2> last_scan_from_robot_;
  StepReport report_;
};

}  // namespace sketchloc
