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
#include "registration/train/detail/losses.hpp"
#include "registration/train/detail/torch_network.hpp"

namespace sketchloc {
namespace {

using detail::TorchNetwork;

/// A view on a batch's numbers; the batch must outlive it.
torch::Tensor view(const std::vector<float>& values, std::vector<std::int64_t> shape) {
  return torch::from_blob(const_cast<float*>(values.data()), shape, torch::kFloat32);
}

/// Convolutions are a fifth faster with the channels of a cell side by side.
void put_channels_last(TorchNetwork& network) {
  for (torch::Tensor& parameter : network.parameters()) {
    if (parameter.dim() == 4) {
      parameter.set_data(parameter.detach().contiguous(torch::MemoryFormat::ChannelsLast));
    }
  }
}

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

NetworkPlan seeded(const Trainer::Plan& plan) {
  torch::manual_seed(plan.seed);  // the first numbers of the network are drawn from it
  return plan_network(plan.kind, plan.window.cells);
}

}  // namespace

class Trainer::Implementation {
 public:
  Implementation(const Plan& plan, const TrainerParams& params)
      : plan_(plan),
        params_(params),
        network_(seeded(plan)),
        average_(plan_network(plan.kind, plan.window.cells)),
        optimizer_(network_.parameters(), torch::optim::AdamOptions(params.learning_rate)),
        spline_(spline_tensor(plan.window)) {
    put_channels_last(network_);
    put_channels_last(average_);
    average_.follow(network_, 1.0);
    average_.eval();
  }

  TrainingLoss learn(const SampleBatch& batch) {
    network_.train();
    set_learning_rate();
    optimizer_.zero_grad();
    const torch::Tensor output = network_.forward(input_of_batch(batch));
    auto [total, parts] = loss_of(output, batch);
    total.backward();
    torch::nn::utils::clip_grad_norm_(network_.parameters(), params_.max_gradient);
    optimizer_.step();
    ++batches_learned_;
    const double young = 10.0 / (10.0 + static_cast<double>(batches_learned_));
    average_.follow(network_, std::max(1.0 - params_.averaging, young));
    parts.total = total.item<double>();
    return parts;
  }

  std::vector<float> predict(const SampleBatch& batch) {
    const torch::NoGradGuard no_gradients;
    const torch::Tensor output = average_.forward(input_of_batch(batch)).contiguous();
    return {output.data_ptr<float>(), output.data_ptr<float>() + output.numel()};
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

  std::string checkpoint() const {
    torch::serialize::OutputArchive archive;
    const auto add = [&](const std::string& name, const auto& part) {
      torch::serialize::OutputArchive inner(archive.compilation_unit());
      part.save(inner);
      archive.write(name, inner);
    };
    add("network", network_);
    add("average", average_);
    add("optimizer", optimizer_);
    archive.write("batches_learned",
                  torch::tensor(static_cast<std::int64_t>(batches_learned_), torch::kInt64));
    std::ostringstream bytes;
    archive.save_to(bytes);
    return bytes.str();
  }

  void restore(const std::string& checkpoint) try {
    torch::serialize::InputArchive archive;
    std::istringstream bytes(checkpoint);
    archive.load_from(bytes);
    const auto read = [&](const std::string& name, auto& part) {
      torch::serialize::InputArchive inner;
      archive.read(name, inner);
      part.load(inner);
    };
    read("network", network_);
    read("average", average_);
    read("optimizer", optimizer_);
    torch::Tensor batches;
    archive.read("batches_learned", batches);
    batches_learned_ = static_cast<std::uint64_t>(batches.item<std::int64_t>());
    put_channels_last(network_);
    put_channels_last(average_);
  } catch (const c10::Error&) {
    throw std::runtime_error("not a checkpoint of this network; was it another --network?");
  }

  std::uint64_t batches_learned() const { return batches_learned_; }
  FoldedNetwork folded() const { return average_.fold(); }

 private:
  torch::Tensor input_of_batch(const SampleBatch& batch) const {
    return view(batch.input, {batch.count, channels_of(sketchloc::input_of(plan_.kind)),
                              plan_.window.cells, plan_.window.cells})
        .contiguous(torch::MemoryFormat::ChannelsLast);
  }

  std::pair<torch::Tensor, TrainingLoss> loss_of(const torch::Tensor& output,
                                                 const SampleBatch& batch) const {
    if (plan_.kind != NetworkKind::Ours) {
      const torch::Tensor sources =
          plan_.kind == NetworkKind::Affine ? detail::affine_sources(output) : output;
      const torch::Tensor truth = view(batch.published_source, {batch.count, 2 * kControls});
      return {detail::published_loss(sources, truth), {}};
    }
    const detail::ResidualTruth truth{
        .grid_shift = view(batch.grid_shift, {batch.count, kGridPoints, 2}),
        .grid_weight = view(batch.grid_weight, {batch.count, kGridPoints}),
        .pose = view(batch.pose, {batch.count, 4}),
        .unit_m = view(batch.unit_m, {batch.count})};
    const detail::ResidualLoss loss = detail::residual_loss(output, truth, spline_);
    return {loss.total(), TrainingLoss{.grid = loss.grid.item<double>(),
                                       .pose = loss.pose.item<double>(),
                                       .spread = loss.spread.item<double>(),
                                       .inlier = loss.inlier.item<double>()}};
  }

  void set_learning_rate() {
    const auto learned = static_cast<double>(batches_learned_);
    const auto total = static_cast<double>(plan_.total_batches);
    const double left = std::max(total - learned, 0.0) / std::max(params_.fall_share * total, 1.0);
    const double rise = (learned + 1.0) / std::max(params_.warm_up_batches, 1);
    const double rate =
        std::lerp(params_.last_learning_rate, params_.learning_rate, std::min(left, 1.0));
    for (torch::optim::OptimizerParamGroup& group : optimizer_.param_groups()) {
      group.options().set_lr(rate * std::min(rise, 1.0));
    }
  }

  Plan plan_;
  TrainerParams params_;
  TorchNetwork network_;
  TorchNetwork average_;  ///< what is used
  torch::optim::Adam optimizer_;
  torch::Tensor spline_;  ///< grid points from control points
  std::uint64_t batches_learned_ = 0;
};

void validate(const TrainerParams& params) {
  require_above("learning_rate", params.learning_rate, 0.0);
  require_in_range("last_learning_rate", params.last_learning_rate, 0.0, params.learning_rate);
  require_at_least("warm_up_batches", params.warm_up_batches, 0.0);
  require_in_range("fall_share", params.fall_share, 0.0, 1.0);
  require_in_range("averaging", params.averaging, 0.0, 0.999999);
  require_above("max_gradient", params.max_gradient, 0.0);
}

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
