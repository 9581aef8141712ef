#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "topology/straight_pieces.hpp"

namespace sketchloc {

/// How odometry loses its heading, and how well buildings keep to right angles.
struct DriftParams {
  double wander_deg = 0.5;  ///< heading error after a metre, grows with the root of the way, > 0
  double turn_error_deg = 3.0;   ///< heading error of a quarter turn, >= 0
  double slope_deg_per_m = 1.0;  ///< 1-sigma of a steady drift, > 0
  double slope_walk_deg = 0.02;  ///< how the slope changes: deg/m in the root of a metre, > 0
  double axis_sigma_deg = 5.0;   ///< straight pieces and walls: 1-sigma, > 0
  double skew_share = 0.05;      ///< of pieces that keep to no wall, in (0, 1)
  double skew_sigma_deg = 25.0;  ///< how far these are off, > axis_sigma_deg
  int hypotheses = 64;           ///< of the turns, > 0
};
void validate(const DriftParams& params);

template <typename Visitor>
void visit_fields(DriftParams& params, Visitor&& visit) {
  visit("wander_deg", params.wander_deg);
  visit("turn_error_deg", params.turn_error_deg);
  visit("slope_deg_per_m", params.slope_deg_per_m);
  visit("slope_walk_deg", params.slope_walk_deg);
  visit("axis_sigma_deg", params.axis_sigma_deg);
  visit("skew_share", params.skew_share);
  visit("skew_sigma_deg", params.skew_sigma_deg);
  visit("hypotheses", params.hypotheses);
}

/// What was decided of a straight piece.
struct PieceHeading {
  int quarter_turns = 0;   ///< its direction in the Manhattan frame
  double on_axis = 1.0;    ///< probability that it runs along a wall
  double drift_rad = 0.0;  ///< heading of the odometry minus true heading, smoothed over the run
};

/// Decides the turns of a run jointly: drift is a random walk with a slope that changes slowly and
/// a kick at every turn; each straight piece measures it up to quarter turns. All likely histories
/// of turns are kept side by side, each with its Kalman filter. Binning every turn on its own fails
/// where the drift passes 45 deg; here it may go round and round.
class DriftTracker {
 public:
  explicit DriftTracker(const DriftParams& params = {});

  /// Pieces come in the order of the way.
  void add(const StraightPiece& piece);

  std::size_t pieces() const { return pieces_.size(); }
  /// Of all pieces so far, by the likeliest history. The first piece's axis is the nearest one.
  std::vector<PieceHeading> headings() const;
  /// Log odds of the likeliest history against the next one; infinite where there is one only.
  double log_odds() const;
  /// Log density of all pieces so far under the likeliest history, up to a constant that depends on
  /// their number alone.
  double log_evidence() const { return log_evidence_; }
  const DriftParams& params() const { return params_; }

 private:
  struct State {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();  ///< drift rad, slope rad/m
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  };
  /// One decision; the histories are a tree.
  struct Decision {
    std::size_t before = 0;  ///< index of the decision before; the first is its own
    int quarter_turns = 0;
    double on_axis = 1.0;
  };
  struct Hypothesis {
    double log_weight = 0.0;
    State state;
    std::size_t decision = 0;
  };

  State predicted(const State& state, std::size_t piece) const;
  Hypothesis extended(const Hypothesis& hypothesis, const State& prior, int quarter_turns);
  void keep_the_likeliest(std::vector<Hypothesis> candidates);
  std::vector<Decision> history(std::size_t decision) const;
  bool agree_lately(std::size_t a, std::size_t b) const;
  void smooth(std::vector<PieceHeading>& headings) const;

  DriftParams params_;
  std::vector<StraightPiece> pieces_;
  std::vector<Decision> decisions_;
  std::vector<Hypothesis> hypotheses_;  ///< the likeliest first
  double log_evidence_ = 0.0;
};

/// Trackers for odometry as good as the parameters say, and for one of twice and of four times the
/// noise: how good it is shows in the run.
std::vector<DriftTracker> drift_trackers(const DriftParams& params);
/// The one with the most evidence; they have seen the same pieces.
const DriftTracker& likeliest(std::span<const DriftTracker> trackers);

/// The drift at every pose: linear in the way between the middles of pieces, steady beyond.
/// Without a piece the odometry is kept: zero.
std::vector<double> drift_at_poses(const Travel& travel, std::span<const StraightPiece> pieces,
                                   std::span<const PieceHeading> headings);

/// The same as if every piece ran along its wall exactly.
std::vector<double> snapped_drift_at_poses(const Travel& travel,
                                           std::span<const StraightPiece> pieces,
                                           std::span<const PieceHeading> headings);

}  // namespace sketchloc
