#include "registration/train/trainer.hpp"

#include <ATen/Parallel.h>
#include <malloc.h>
#include <torch/torch.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "motion/check.hpp"
#include "motion/validate.hpp"
#include "registration/train/detail/learner.hpp"
#include "registration/train/detail/losses.hpp"

namespace sketchloc {
namespace {

using detail::view;

torch::Tensor spline_tensor(const LocalWindow& window) {
  const Eigen::MatrixXf matrix =
      spline_matrix(control_points_in_robot(window), grid_points_in_robot(window)).cast<float>();
  torch::Tensor tensor = torch::empty({matrix.rows(), matrix.cols()});
  for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
    for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
      tensor.data_ptr<float>()[row * matrix.cols() + column] = matrix(row, column);
    }
  }
  return tensor;
}

detail::Learner learner_of(const Trainer::Plan& plan, const TrainerParams& params) {
  const detail::Learner::Course course{.seed = plan.seed, .total_batches = plan.total_batches};
  return plan.from ? detail::Learner(*plan.from, params, course)
                   : detail::Learner(plan_network(plan.kind, plan.window.cells), params, course);
}

}  // namespace

class Trainer::Implementation {
 public:
  Implementation(const Plan& plan, const TrainerParams& params)
      : plan_(plan), learner_(learner_of(plan, params)), spline_(spline_tensor(plan.window)) {}

  TrainingLoss learn(const SampleBatch& batch) {
    TrainingLoss parts;
    parts.total = learner_.learn(input_of_batch(batch), [&](const torch::Tensor& output) {
      return loss_of(output, batch, parts);
    });
    return parts;
  }

  std::vector<float> predict(const SampleBatch& batch) {
    return learner_.predict(input_of_batch(batch));
  }

  ValidationReport validate(std::span<const SampleBatch> batches) {
    ValidationErrors errors;
    for (const SampleBatch& batch : batches) {
      const std::vector<float> outputs = predict(batch);
      const std::size_t size = outputs.size() / static_cast<std::size_t>(batch.count);
      for (std::size_t i = 0; i < static_cast<std::size_t>(batch.count); ++i) {
        const Sim2& prior = batch.prior_sketch_from_robot[i];
        const std::span<const float> output = std::span(outputs).subspan(i * size, size);
        errors.add(batch.sketch_from_robot[i], prior,
                   pose_of(plan_.kind, output, prior, plan_.window));
      }
    }
    return errors.report();
  }

  std::string checkpoint() const { return learner_.checkpoint(); }
  void restore(const std::string& checkpoint) { learner_.restore(checkpoint); }
  std::uint64_t batches_learned() const { return learner_.batches_learned(); }
  FoldedNetwork folded() const { return learner_.folded(); }

 private:
  torch::Tensor input_of_batch(const SampleBatch& batch) const {
    return view(batch.input, {batch.count, channels_of(sketchloc::input_of(plan_.kind)),
                              plan_.window.cells, plan_.window.cells})
        .contiguous(torch::MemoryFormat::ChannelsLast);
  }

  /// Tells the parts too.
  torch::Tensor loss_of(const torch::Tensor& output, const SampleBatch& batch,
                        TrainingLoss& parts) const {
    if (plan_.kind != NetworkKind::Ours) {
      const torch::Tensor sources =
          plan_.kind == NetworkKind::Affine ? detail::affine_sources(output) : output;
      const torch::Tensor truth = view(batch.published_source, {batch.count, 2 * kControls});
      return detail::published_loss(sources, truth);
    }
    const detail::ResidualTruth truth{
        .grid_shift = view(batch.grid_shift, {batch.count, kGridPoints, 2}),
        .grid_weight = view(batch.grid_weight, {batch.count, kGridPoints}),
        .pose = view(batch.pose, {batch.count, 4}),
        .unit_m = view(batch.unit_m, {batch.count})};
    const detail::ResidualLoss loss = detail::residual_loss(output, truth, spline_);
    parts = {.grid = loss.grid.item<double>(),
             .pose = loss.pose.item<double>(),
             .spread = loss.spread.item<double>(),
             .inlier = loss.inlier.item<double>()};
    return loss.total();
  }

  Plan plan_;
  detail::Learner learner_;
  torch::Tensor spline_;  ///< grid points from control points
};

Trainer::Trainer(const Plan& plan, const TrainerParams& params) {
  sketchloc::validate(params);
  sketchloc::validate(plan.window);
  check(plan.total_batches > 0, "there is something to learn");
  implementation_ = std::make_unique<Implementation>(plan, params);
}

Trainer::~Trainer() = default;

TrainingLoss Trainer::learn(const SampleBatch& batch) { return implementation_->learn(batch); }
std::uint64_t Trainer::batches_learned() const { return implementation_->batches_learned(); }
std::vector<float> Trainer::predict(const SampleBatch& batch) const {
  return implementation_->predict(batch);
}
ValidationReport Trainer::validate(std::span<const SampleBatch> batches) const {
  return implementation_->validate(batches);
}
std::string Trainer::checkpoint() const { return implementation_->checkpoint(); }
void Trainer::restore(const std::string& checkpoint) { implementation_->restore(checkpoint); }
FoldedNetwork Trainer::folded() const { return implementation_->folded(); }

void set_learning_threads(int threads) {
  at::set_num_threads(threads);
  // Keep freed memory: giving it back after every batch costs a sixth of the time.
  constexpr int kForever = std::numeric_limits<int>::max();
  mallopt(M_MMAP_THRESHOLD, kForever);
  mallopt(M_TRIM_THRESHOLD, kForever);
}

}  // namespace sketchloc
