#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "datasets/run.hpp"
#include "registration/sketch_crop.hpp"
#include "registration/warp_predictor.hpp"
#include "smoothing/keyframes.hpp"

namespace sketchloc {

/// When a registration in hindsight is spared.
struct HindsightParams {
  double known_m = 0.2;    ///< from a prior this near to an earlier one nothing new is found, > 0
  double known_rad = 0.1;  ///< and headed this alike, > 0
};

template <typename Visitor>
void visit_fields(HindsightParams& params, Visitor&& visit) {
  visit("known_m", params.known_m);
  visit("known_rad", params.known_rad);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const HindsightParams& params);

/// The keyframes of the last metres of a run that grows, with the scans that registering them
/// needs. Keyframes are numbered from the first one of the run on.
class KeyframeWindow {
 public:
  /// The predictor must outlive it.
  KeyframeWindow(const SketchCropper& drawing, WarpPredictor& predictor,
                 const KeyframeParams& params, const HindsightParams& hindsight);

  /// Takes the next scan with its odometry, and what a filter believes there, the likeliest first,
  /// not empty. Says whether it became a keyframe, the newest one.
  bool add(const RunStep& step, std::span<const PoseHypothesis> believed);

  std::size_t first() const { return first_; }
  std::size_t end() const { return first_ + keyframes_.size(); }
  const Keyframe& at(std::size_t keyframe) const;
  const std::vector<PoseHypothesis>& believed_at(std::size_t keyframe) const;
  double way_m() const { return way_m_; }          ///< from the first scan to the last one
  double way_m(std::size_t keyframe) const;        ///< from the first scan to a keyframe
  bool saw_all_after(std::size_t keyframe) const;  ///< whether the scans after it are there
  std::span<const Keyframe> keyframes() const { return keyframes_; }
  /// From the scan of the window's first keyframe to that of this one.
  std::span<const RunStep> scans_until(std::size_t keyframe) const;
  std::size_t scan_of(std::size_t keyframe) const;  ///< its index among those

  /// Registers the scans before a keyframe from where the filter believed to be.
  void look_as_it_came(std::size_t keyframe);

  /// Registers the scans after a keyframe, and those of both sides, from each prior where that has
  /// not been done.
  void look_back(std::size_t keyframe, std::span<const Sim2> priors);

  /// Forgets keyframes, and the scans that only they need.
  void forget_before(std::size_t keyframe);

 private:
  struct Place {
    double way_m = 0.0;
    std::size_t scan = 0;  ///< index of its scan, counted from the first kept one of the run on
    std::vector<PoseHypothesis> believed;
    std::vector<Sim2> looked_back_from = {};
  };

  bool moves(const RunStep& step);
  std::vector<PoseHypothesis> register_side(std::size_t keyframe, Around which,
                                            std::span<const Sim2> priors) const;
  bool has_looked_from(const Place& place, const Sim2& prior) const;
  std::size_t index_of(std::size_t keyframe) const;

  SketchCropper drawing_;
  WarpPredictor* predictor_;
  KeyframeParams params_;
  HindsightParams hindsight_;
  std::vector<RunStep> scans_;  ///< a little way apart
  std::size_t scans_forgotten_ = 0;
  std::size_t first_ = 0;
  std::vector<Keyframe> keyframes_;
  std::vector<Place> places_;
  std::size_t steps_ = 0;
  double way_m_ = 0.0;
  double keyframe_way_m_ = 0.0;  ///< since the last keyframe
  double keyframe_turn_rad_ = 0.0;
};

}  // namespace sketchloc
