#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "apps/localizer_options.hpp"
#include "datasets/io/run_io.hpp"
#include "datasets/io/sketch_io.hpp"
#include "filter/online/tracker.hpp"
#include "registration/network_predictor.hpp"
#include "smoothing/lag_smoother.hpp"

namespace CLI {
class App;
}

namespace sketchloc {

struct TrackParams {
  LocalizerParams localizer;
  MatchedOdometryParams odometry;
  NetworkPredictorParams predictor;
  TrackerParams tracker;
  LagSmootherParams smoothing;
};

template <typename Visitor>
void visit_fields(TrackParams& params, Visitor&& visit) {
  visit("localizer", params.localizer);
  visit("odometry", params.odometry);
  visit("predictor", params.predictor);
  visit("tracker", params.tracker);
  visit("smoothing", params.smoothing);
}

/// Throws std::invalid_argument naming the component and field, its range and its value.
void validate(const TrackParams& params);

/// What `sketchloc track` is told.
struct TrackOptions {
  std::filesystem::path map;  ///< a drawing, or a folder with one and its reference

  StartOptions start;
  MethodOptions method;

  bool from_stdin = false;  ///< the default
  std::optional<std::uint16_t> listen;
  std::filesystem::path replay;       ///< a log; empty: none
  std::optional<double> rate;         ///< of the replay, seconds per second; 0: as fast as possible
  std::optional<double> deadline_ms;  ///< 0: none
  bool lag = false;                   ///< smoothed poses too, a way later
  RunReading reading;                 ///< of the log

  std::filesystem::path out;    ///< empty: stdout
  std::filesystem::path state;  ///< empty: none is kept
  double state_every_s = 1.0;
  bool resume = false;
  bool force = false;

  SketchReading drawing;
  ParameterOptions parameters;
};

/// Follows a robot in a drawing while it drives. Throws std::invalid_argument for options that do
/// not fit together, std::runtime_error where the data fail.
void run_track(const TrackOptions& options);

void add_track_command(CLI::App& program);

}  // namespace sketchloc
