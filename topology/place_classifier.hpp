#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "datasets/place_label.hpp"
#include "registration/local_window.hpp"
#include "registration/onnx_network.hpp"
#include "registration/recent_scans.hpp"
#include "registration/scan_raster.hpp"

namespace sketchloc {

inline constexpr std::size_t kPlaceLabels = 3;

/// What the classifier looks at: the window that its network was trained with.
struct PlaceClassifierParams {
  LocalWindow window{.side_m = 12.8, .cells = 64};
  RecentScansParams scans = {};
  double stay_way_m = 1.0;  ///< mean way between two changes of what scans say, > 0
};
void validate(const PlaceClassifierParams& params);

template <typename Visitor>
void visit_fields(PlaceClassifierParams& params, Visitor&& visit) {
  visit("window", params.window);
  visit("scans", params.scans);
  visit("stay_way_m", params.stay_way_m);
}

/// The planes that the network sees: end points, then seen free. `submap`: not empty.
std::vector<float> place_input(std::span<const PlacedScan> submap, const LocalWindow& window);

/// One probability for each PlaceLabel, in its order; they sum to 1.
using PlaceProbabilities = std::array<double, kPlaceLabels>;

/// The label with the greatest probability.
PlaceLabel likeliest(const PlaceProbabilities& probabilities);

/// Tells from the scans of the last metres what kind of place a robot is at. Where [Topo20] looks
/// at pictures of a camera, this looks at the raster of a LIDAR. Not safe to share between threads.
class PlaceClassifier {
 public:
  /// A network that `sketchloc train --network places` made, as the bytes of an ONNX file. Throws
  /// std::runtime_error where it is none, std::invalid_argument for parameters out of range.
  explicit PlaceClassifier(std::span<const std::uint8_t> onnx,
                           const PlaceClassifierParams& params = {});

  const PlaceClassifierParams& params() const { return params_; }

  /// `submap`: as RecentScans places it, not empty; the present scan comes first.
  PlaceProbabilities classify(std::span<const PlacedScan> submap);

 private:
  PlaceClassifierParams params_;
  OnnxNetwork network_;
};

/// The kind of place at every step of a drive, which changes now and then: by what all scans say,
/// those before and those after (forward-backward in a chain of three states). Odometry as good as
/// matched_odometry's is needed.
std::vector<PlaceLabel> classify_places(PlaceClassifier& classifier, std::span<const Scan> scans,
                                        std::span<const Se2> odom_from_robot);

}  // namespace sketchloc
