#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "registration/train/sample.hpp"

namespace sketchloc {

/// Samples side by side, ready for a tensor; field by field as in Sample.
struct SampleBatch {
  int count = 0;
  std::vector<float> input;
  std::vector<float> control_shift;
  std::vector<float> grid_shift;
  std::vector<float> grid_weight;
  std::vector<float> published_source;
  std::vector<float> pose;
  std::vector<float> unit_m;  ///< one for each sample, see unit_m
  std::vector<Sim2> sketch_from_robot;
  std::vector<Sim2> prior_sketch_from_robot;
};

/// How samples are made and dealt.
struct SampleSourceParams {
  SceneParams scene{};
  SampleParams sample{};
  int scenes = 32;              ///< in use at a time, >= 1
  int samples_per_scene = 512;  ///< after these a scene gives way to a new one, >= 1
  int batch = 128;              ///< a multiple of `scenes`, so that every batch has all of them
};

template <typename Visitor>
void visit_fields(SampleSourceParams& source, Visitor&& visit) {
  visit("scene", source.scene);
  visit("sample", source.sample);
  visit("scenes", source.scenes);
  visit("samples_per_scene", source.samples_per_scene);
  visit("batch", source.batch);
}

/// Throws std::invalid_argument naming the field, its range and its value.
void validate(const SampleSourceParams& params);

/// Worlds that never meet: buildings, people and robots of one are not in the other.
enum class SampleSplit : std::uint64_t { Training, Validation };

/// The seed of one purpose of a split; what is drawn for one never meets another.
std::uint64_t split_seed(SampleSplit split, std::uint64_t seed, std::uint64_t purpose);

/// An endless stream of samples, made by threads of its own. Batch n is the same for a seed and a
/// split, whatever the number of threads and wherever the stream starts.
class SampleSource {
 public:
  struct Stream {
    InputKind kind = InputKind::Residual;
    SampleSplit split = SampleSplit::Training;
    std::uint64_t seed = 1;
    std::uint64_t first_batch = 0;
    /// A network of ours, as the bytes of an ONNX file, that improves priors (PriorError); empty:
    /// nothing does.
    std::string improving_network = {};
    bool registered = false;  ///< samples as of draw_registered, by that network
  };

  SampleSource(const SampleSourceParams& params, const Stream& stream, int threads);
  ~SampleSource();
  SampleSource(const SampleSource&) = delete;
  SampleSource& operator=(const SampleSource&) = delete;

  /// The next batch; waits for it. Throws what a thread threw.
  SampleBatch next();

 private:
  class Work;
  std::unique_ptr<Work> work_;
};

}  // namespace sketchloc
