#include "apps/place_task.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "apps/interrupt.hpp"
#include "registration/shipped_networks.hpp"
#include "registration/train/place_trainer.hpp"
#include "registration/verified_predictor.hpp"

namespace sketchloc {
namespace {

/// Gives batch `number` of a split.
using BatchMaker = std::function<PlaceBatch(SampleSplit split, std::uint64_t number)>;

/// An answer that the curve tells recall and precision of.
struct Answer {
  std::size_t index = 0;
  std::string_view recall_column;
  std::string_view precision_column;
};

class PlaceLearning final : public LearningTask {
 public:
  struct Kind {
    PlaceTask task = PlaceTask::Labels;
    int cells = 1;
    int batch = 1;
    std::vector<Answer> answers;
    std::optional<FoldedNetwork> from = std::nullopt;
  };

  PlaceLearning(Kind kind, BatchMaker make_batch, const LearningPlan& plan)
      : kind_(std::move(kind)),
        plan_(plan),
        make_batch_(std::move(make_batch)),
        trainer_({.task = kind_.task,
                  .cells = kind_.cells,
                  .seed = plan.seed,
                  .total_batches = batches_of(plan.samples, kind_.batch),
                  .from = kind_.from},
                 plan.trainer) {}

  int samples_per_batch() const override { return kind_.batch; }
  std::uint64_t batches_learned() const override { return trainer_.batches_learned(); }
  void go_on(const std::filesystem::path& /*point*/) override {}

  void learn_batch() override {
    loss_sum_ += trainer_.learn(make_batch_(SampleSplit::Training, trainer_.batches_learned()));
    ++losses_;
  }

  std::vector<std::string_view> columns() const override {
    std::vector<std::string_view> columns = {"loss", "accuracy_percent"};
    for (const Answer& answer : kind_.answers) {
      columns.push_back(answer.recall_column);
      columns.push_back(answer.precision_column);
    }
    return columns;
  }

  Measured measure() override {
    while (std::ssize(validation_) < plan_.validation_batches) {
      validation_.push_back(make_batch_(SampleSplit::Validation, validation_.size()));
      throw_if_interrupted();
    }
    const ConfusionMatrix confusion = trainer_.validate(validation_);
    const double loss = loss_sum_ / std::max(losses_, 1);
    const double right_percent = 100.0 * confusion.accuracy();
    Measured measured{.columns = {loss, right_percent},
                      .summary = fmt::format("loss {:.4f}, {:.2f} % right", loss, right_percent)};
    for (const Answer& answer : kind_.answers) {
      measured.columns.push_back(100.0 * confusion.recall(answer.index));
      measured.columns.push_back(100.0 * confusion.precision(answer.index));
    }
    loss_sum_ = 0.0;
    losses_ = 0;
    return measured;
  }

  std::vector<CurvePanel> panels() const override {
    return {{.title = "Right answers", .column = "accuracy_percent", .unit = "%"}};
  }

  std::string checkpoint() const override { return trainer_.checkpoint(); }
  void restore(const std::string& checkpoint) override { trainer_.restore(checkpoint); }
  std::string network() const override { return onnx_bytes(trainer_.folded()); }

 private:
  Kind kind_;
  LearningPlan plan_;
  BatchMaker make_batch_;
  PlaceTrainer trainer_;
  std::vector<PlaceBatch> validation_;
  double loss_sum_ = 0.0;
  int losses_ = 0;
};

std::uint64_t seed_of(SampleSplit split, const LearningPlan& plan) {
  return split == SampleSplit::Training ? plan.seed : 0;  // the validation is the same for all
}

/// Registrations of both splits, and whether the robot was there. Each split's are asked for one
/// after the other.
class RegisteredBatches {
 public:
  RegisteredBatches(const SampleSourceParams& params, const LearningPlan& plan, std::string network)
      : params_(params), plan_(plan), network_(std::move(network)) {}

  PlaceBatch batch(SampleSplit split, std::uint64_t number) {
    std::unique_ptr<SampleSource>& source = sources_[split];
    if (!source) {
      source = source_from(split, number);
    }
    const SampleBatch registered = source->next();
    PlaceBatch batch{.count = registered.count, .input = registered.input};
    for (std::size_t i = 0; i < registered.sketch_from_robot.size(); ++i) {
      const Sim2& truth = registered.sketch_from_robot[i];
      const Sim2 truth_from_found = truth.inverse() * registered.prior_sketch_from_robot[i];
      const bool right = truth_from_found.translation().norm() < kVerified_m &&
                         std::abs(truth_from_found.yaw_rad()) < kVerified_rad;
      batch.answer.push_back(right ? 1 : 0);
    }
    return batch;
  }

 private:
  std::unique_ptr<SampleSource> source_from(SampleSplit split, std::uint64_t number) const {
    SampleSourceParams params = params_;
    if (split == SampleSplit::Validation) {
      params.samples_per_scene = std::max(1, params.batch / params.scenes);  // many buildings
    }
    const SampleSource::Stream stream{.kind = InputKind::Residual,
                                      .split = split,
                                      .seed = seed_of(split, plan_),
                                      .first_batch = number,
                                      .improving_network = network_,
                                      .registered = true};
    return std::make_unique<SampleSource>(params, stream, plan_.workers);
  }

  SampleSourceParams params_;
  LearningPlan plan_;
  std::string network_;
  std::map<SampleSplit, std::unique_ptr<SampleSource>> sources_;
};

std::string network_of_ours() {
  const std::span<const std::uint8_t> shipped = shipped_network(NetworkKind::Ours);
  if (shipped.empty()) {
    throw std::invalid_argument(
        "verify learns from what ours registers, and no network of ours "
        "comes with this program");
  }
  return {reinterpret_cast<const char*>(shipped.data()), shipped.size()};
}

}  // namespace

std::unique_ptr<LearningTask> make_label_task(const PlaceSampleParams& samples,
                                              const LearningPlan& plan) {
  PlaceSampleParams held_out = samples;
  held_out.samples_per_scene = std::max(1, samples.batch / samples.scenes);  // many buildings
  const auto make = [training = std::make_shared<PlaceSamples>(
                         samples, SampleSplit::Training, seed_of(SampleSplit::Training, plan)),
                     validation =
                         std::make_shared<PlaceSamples>(held_out, SampleSplit::Validation, 0)](
                        SampleSplit split, std::uint64_t number) {
    return (split == SampleSplit::Training ? training : validation)->batch(number);
  };
  const auto index = [](PlaceLabel label) { return static_cast<std::size_t>(label); };
  return std::make_unique<PlaceLearning>(
      PlaceLearning::Kind{
          .task = PlaceTask::Labels,
          .cells = samples.look.window.cells,
          .batch = samples.batch,
          .answers = {{index(PlaceLabel::Rackspace), "rackspace_recall_percent",
                       "rackspace_precision_percent"},
                      {index(PlaceLabel::Corridor), "corridor_recall_percent",
                       "corridor_precision_percent"},
                      {index(PlaceLabel::Intersection), "intersection_recall_percent",
                       "intersection_precision_percent"}}},
      make, plan);
}

std::unique_ptr<LearningTask> make_same_place_task(const NodePairParams& pairs,
                                                   const LearningPlan& plan) {
  const auto make = [pairs, plan](SampleSplit split, std::uint64_t number) {
    return node_pairs(pairs, split, seed_of(split, plan), number);
  };
  return std::make_unique<PlaceLearning>(
      PlaceLearning::Kind{.task = PlaceTask::SamePlace,
                          .cells = 1,
                          .batch = pairs.batch,
                          .answers = {{1, "same_recall_percent", "same_precision_percent"}}},
      make, plan);
}

std::unique_ptr<LearningTask> make_verification_task(const SampleSourceParams& source,
                                                     const LearningPlan& plan) {
  const std::string network = network_of_ours();
  const int cells = source.sample.cells;
  const auto batches = std::make_shared<RegisteredBatches>(source, plan, network);
  return std::make_unique<PlaceLearning>(
      PlaceLearning::Kind{.task = PlaceTask::Verification,
                          .cells = cells,
                          .batch = source.batch,
                          .answers = {{1, "right_recall_percent", "right_precision_percent"}},
                          .from = verification_of(
                              network_of_onnx(plan_network(NetworkKind::Ours, cells), network))},
      [batches](SampleSplit split, std::uint64_t number) { return batches->batch(split, number); },
      plan);
}

}  // namespace sketchloc
