#include "registration/train/sample_source.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <span>
#include <thread>

#include "motion/check.hpp"
#include "motion/validate.hpp"
#include "registration/network_output.hpp"
#include "registration/network_predictor.hpp"

namespace sketchloc {
namespace {

constexpr std::uint64_t kBatchesAhead = 4;

void put(std::vector<float>& all, std::size_t index, std::span<const float> one) {
  std::copy(one.begin(), one.end(), all.begin() + static_cast<std::ptrdiff_t>(index * one.size()));
}

SampleBatch empty_batch(const SampleSourceParams& params, InputKind kind) {
  const auto count = static_cast<std::size_t>(params.batch);
  const auto cells = static_cast<std::size_t>(params.sample.cells);
  const Sample one;
  return {.count = params.batch,
          .input = std::vector<float>(count * static_cast<std::size_t>(channels_of(kind)) * cells *
                                      cells),
          .control_shift = std::vector<float>(count * one.control_shift.size()),
          .grid_shift = std::vector<float>(count * one.grid_shift.size()),
          .grid_weight = std::vector<float>(count * one.grid_weight.size()),
          .published_source = std::vector<float>(count * one.published_source.size()),
          .pose = std::vector<float>(count * one.pose.size()),
          .unit_m = std::vector<float>(count),
          .sketch_from_robot = std::vector<Sim2>(count),
          .prior_sketch_from_robot = std::vector<Sim2>(count)};
}

void put(SampleBatch& batch, std::size_t index, const Sample& sample) {
  put(batch.input, index, sample.input);
  put(batch.control_shift, index, sample.control_shift);
  put(batch.grid_shift, index, sample.grid_shift);
  put(batch.grid_weight, index, sample.grid_weight);
  put(batch.published_source, index, sample.published_source);
  put(batch.pose, index, sample.pose);
  batch.unit_m[index] = static_cast<float>(unit_m(sample.window));
  batch.sketch_from_robot[index] = sample.sketch_from_robot;
  batch.prior_sketch_from_robot[index] = sample.prior_sketch_from_robot;
}

}  // namespace

std::uint64_t split_seed(SampleSplit split, std::uint64_t seed, std::uint64_t purpose) {
  return make_rng(seed, static_cast<std::uint64_t>(split), purpose)();
}

/// Every scene has a place in all batches, and one thread for good, so that nobody shares it.
class SampleSource::Work {
 public:
  Work(const SampleSourceParams& params, const Stream& stream, int threads)
      : params_(params),
        stream_(stream),
        scene_seed_(split_seed(stream.split, stream.seed, 0)),
        sample_seed_(split_seed(stream.split, stream.seed, 1)),
        consumed_(stream.first_batch),
        scenes_(static_cast<std::size_t>(params.scenes)) {
    validate(params);
    check(threads >= 1, "somebody makes the samples");
    thread_count_ = std::min(threads, params.scenes);
    for (std::uint64_t ahead = 0; ahead < kBatchesAhead; ++ahead) {
      open_place();
    }
    for (int thread = 0; thread < thread_count_; ++thread) {
      threads_.emplace_back([this, thread](const std::stop_token& stop) { run(thread, stop); });
    }
  }

  ~Work() {
    for (std::jthread& thread : threads_) {
      thread.request_stop();
    }
    changed_.notify_all();
  }

  SampleBatch next() {
    std::unique_lock lock(mutex_);
    Place& place = places_[consumed_ % kBatchesAhead];
    changed_.wait(lock, [&] { return place.threads_left == 0 || failure_; });
    if (failure_) {
      std::rethrow_exception(failure_);
    }
    SampleBatch batch = std::move(place.batch);
    ++consumed_;
    open_place();
    changed_.notify_all();
    return batch;
  }

 private:
  struct Place {
    SampleBatch batch;
    int threads_left = 0;
  };
  struct Slot {
    std::optional<Scene> scene;
    std::uint64_t generation = 0;
  };

  void open_place() {
    places_[opened_++ % kBatchesAhead] = {.batch = empty_batch(params_, stream_.kind),
                                          .threads_left = thread_count_};
  }

  void run(int thread, const std::stop_token& stop) {
    try {
      const std::unique_ptr<WarpPredictor> once = improving_network(1);
      const std::unique_ptr<WarpPredictor> twice = improving_network(2);
      for (std::uint64_t batch = stream_.first_batch; !stop.stop_requested(); ++batch) {
        {
          std::unique_lock lock(mutex_);
          changed_.wait(lock, stop, [&] { return batch < consumed_ + kBatchesAhead; });
        }
        fill(thread, batch, {.once = once.get(), .twice = twice.get()}, stop);
        const std::lock_guard lock(mutex_);
        --places_[batch % kBatchesAhead].threads_left;
        changed_.notify_all();
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
      changed_.notify_all();
    }
  }

  std::unique_ptr<WarpPredictor> improving_network(int looks) const {
    if (stream_.improving_network.empty()) {
      return nullptr;
    }
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(stream_.improving_network.data());
    return make_network_predictor({bytes, stream_.improving_network.size()}, NetworkKind::Ours,
                                  {.window = params_.sample.window(),
                                   .looks = looks,
                                   .fine_side_m = std::sqrt(params_.sample.min_fine_side_m *
                                                            params_.sample.max_fine_side_m)});
  }

  /// This thread's scenes' part of a batch.
  void fill(int thread, std::uint64_t batch, const ImprovingNetworks& networks,
            const std::stop_token& stop) {
    SampleBatch& target = places_[batch % kBatchesAhead].batch;
    for (int slot = thread; slot < params_.scenes; slot += thread_count_) {
      for (int index = slot; index < params_.batch && !stop.stop_requested();
           index += params_.scenes) {
        const std::uint64_t sample =
            batch * static_cast<std::uint64_t>(params_.batch) + static_cast<std::uint64_t>(index);
        Rng rng = make_rng(sample_seed_, sample);
        const Scene& scene = scene_for(slot, sample);
        put(target, static_cast<std::size_t>(index),
            stream_.registered ? draw_registered(scene, params_.sample, rng, networks)
                               : draw_sample(scene, params_.sample, stream_.kind, rng, networks));
      }
    }
  }

  /// Scenes change one after the other, not all in the same batch.
  const Scene& scene_for(int slot, std::uint64_t sample) {
    const auto scenes = static_cast<std::uint64_t>(params_.scenes);
    const auto life = static_cast<std::uint64_t>(params_.samples_per_scene);
    const std::uint64_t of_slot =
        sample / scenes + static_cast<std::uint64_t>(slot) * life / scenes;
    const std::uint64_t generation = of_slot / life;
    Slot& here = scenes_[static_cast<std::size_t>(slot)];
    if (!here.scene || here.generation != generation) {
      Rng rng = make_rng(scene_seed_, static_cast<std::uint64_t>(slot), generation);
      here.scene.reset();
      here.scene.emplace(params_.scene, rng);
      here.generation = generation;
    }
    return *here.scene;
  }

  SampleSourceParams params_;
  Stream stream_;
  std::uint64_t scene_seed_;
  std::uint64_t sample_seed_;
  int thread_count_ = 0;
  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::exception_ptr failure_;
  std::uint64_t consumed_;  ///< batches handed out before this one
  std::uint64_t opened_ = stream_.first_batch;
  std::array<Place, kBatchesAhead> places_;
  std::vector<Slot> scenes_;
  std::vector<std::jthread> threads_;  ///< last: they end before what they use
};

void validate(const SampleSourceParams& params) {
  validate(params.scene);
  validate(params.sample);
  require_at_least("scenes", params.scenes, 1.0);
  require_at_least("samples_per_scene", params.samples_per_scene, 1.0);
  require_at_least("batch", params.batch, params.scenes);
  require_in_range("batch % scenes", params.batch % params.scenes, 0.0, 0.0);
}

SampleSource::SampleSource(const SampleSourceParams& params, const Stream& stream, int threads)
    : work_(std::make_unique<Work>(params, stream, threads)) {}

SampleSource::~SampleSource() = default;

SampleBatch SampleSource::next() { return work_->next(); }

}  // namespace sketchloc
