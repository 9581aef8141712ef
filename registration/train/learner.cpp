#include "registration/train/detail/learner.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "motion/validate.hpp"

namespace sketchloc {

void validate(const TrainerParams& params) {
  require_above("learning_rate", params.learning_rate, 0.0);
  require_in_range("last_learning_rate", params.last_learning_rate, 0.0, params.learning_rate);
  require_at_least("warm_up_batches", params.warm_up_batches, 0.0);
  require_in_range("fall_share", params.fall_share, 0.0, 1.0);
  require_in_range("averaging", params.averaging, 0.0, 0.999999);
  require_above("max_gradient", params.max_gradient, 0.0);
}

namespace detail {
namespace {

/// Convolutions are a fifth faster with the channels of a cell side by side.
void put_channels_last(TorchNetwork& network) {
  for (torch::Tensor& parameter : network.parameters()) {
    if (parameter.dim() == 4) {
      parameter.set_data(parameter.detach().contiguous(torch::MemoryFormat::ChannelsLast));
    }
  }
}

const NetworkPlan& seeded(const NetworkPlan& plan, std::uint64_t seed) {
  torch::manual_seed(seed);  // the first numbers of the network are drawn from it
  return plan;
}

}  // namespace

torch::Tensor view(const std::vector<float>& values, const std::vector<std::int64_t>& shape) {
  return torch::from_blob(const_cast<float*>(values.data()), shape, torch::kFloat32);
}

Learner::Learner(const NetworkPlan& plan, const TrainerParams& params, const Course& course)
    : Learner(TorchNetwork(seeded(plan, course.seed)), TorchNetwork(plan), params, course) {}

Learner::Learner(const FoldedNetwork& trained, const TrainerParams& params, const Course& course)
    : Learner(TorchNetwork(trained), TorchNetwork(trained), params, course) {}

Learner::Learner(TorchNetwork network, TorchNetwork average, const TrainerParams& params,
                 const Course& course)
    : params_(params),
      course_(course),
      network_(std::move(network)),
      average_(std::move(average)),
      optimizer_(network_.parameters(), torch::optim::AdamOptions(params.learning_rate)) {
  put_channels_last(network_);
  put_channels_last(average_);
  average_.follow(network_, 1.0);
  average_.eval();
}

double Learner::learn(const torch::Tensor& input, const Loss& loss) {
  network_.train();
  set_learning_rate();
  optimizer_.zero_grad();
  const torch::Tensor total = loss(network_.forward(input));
  total.backward();
  torch::nn::utils::clip_grad_norm_(network_.parameters(), params_.max_gradient);
  optimizer_.step();
  ++batches_learned_;
  const double young = 10.0 / (10.0 + static_cast<double>(batches_learned_));
  average_.follow(network_, std::max(1.0 - params_.averaging, young));
  return total.item<double>();
}

std::vector<float> Learner::predict(const torch::Tensor& input) {
  const torch::NoGradGuard no_gradients;
  const torch::Tensor output = average_.forward(input).contiguous();
  return {output.data_ptr<float>(), output.data_ptr<float>() + output.numel()};
}

std::string Learner::checkpoint() const {
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

void Learner::restore(const std::string& checkpoint) try {
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
  throw std::runtime_error("not a checkpoint of this network; was it another --network or --from?");
}

void Learner::set_learning_rate() {
  const auto learned = static_cast<double>(batches_learned_);
  const auto total = static_cast<double>(course_.total_batches);
  const double left = std::max(total - learned, 0.0) / std::max(params_.fall_share * total, 1.0);
  const double rise = (learned + 1.0) / std::max(params_.warm_up_batches, 1);
  const double rate =
      std::lerp(params_.last_learning_rate, params_.learning_rate, std::min(left, 1.0));
  for (torch::optim::OptimizerParamGroup& group : optimizer_.param_groups()) {
    group.options().set_lr(rate * std::min(rise, 1.0));
  }
}

}  // namespace detail
}  // namespace sketchloc
