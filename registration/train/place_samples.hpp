#pragma once

#include <cstdint>
#include <vector>

#include "registration/train/place_batch.hpp"
#include "registration/train/sample_source.hpp"
#include "topology/place_classifier.hpp"

namespace sketchloc {

/// From what kinds of places are learned.
struct PlaceSampleParams {
  SceneParams scene{.drive_m = 160.0};  ///< its drive and scanners; nobody draws
  double office_share = 0.15;           ///< of the buildings; the others are warehouses, in [0, 1]
  PlaceClassifierParams look = {};
  OdometryNoise submap_noise = SampleParams{}.submap_noise;
  int scenes = 32;              ///< in use at a time, >= 1
  int samples_per_scene = 192;  ///< after these a scene gives way to a new one, >= 1
  int batch = 128;              ///< >= 1
};

template <typename Visitor>
void visit_fields(PlaceSampleParams& params, Visitor&& visit) {
  visit("scene", params.scene);
  visit("office_share", params.office_share);
  visit("look", params.look);
  visit("submap_noise", params.submap_noise);
  visit("scenes", params.scenes);
  visit("samples_per_scene", params.samples_per_scene);
  visit("batch", params.batch);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const PlaceSampleParams& params);

/// Rasters of what robots saw in simulated buildings, and what kinds of places those were
/// (PlaceLabeller); half of them in the mirror. A batch is a function of seed, split and number.
class PlaceSamples {
 public:
  PlaceSamples(const PlaceSampleParams& params, SampleSplit split, std::uint64_t seed);
  ~PlaceSamples();
  PlaceSamples(const PlaceSamples&) = delete;
  PlaceSamples& operator=(const PlaceSamples&) = delete;

  PlaceBatch batch(std::uint64_t number);

 private:
  struct LabelledDrive;
  struct Slot;
  const LabelledDrive& drive_for(std::size_t slot, std::uint64_t sample);

  PlaceSampleParams params_;
  std::uint64_t drive_seed_;
  std::uint64_t sample_seed_;
  std::vector<Slot> slots_;
};

}  // namespace sketchloc
