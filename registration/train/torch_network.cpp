#include "registration/train/detail/torch_network.hpp"

#include <cmath>

namespace sketchloc::detail {
namespace {

std::vector<float> numbers(const torch::Tensor& tensor) {
  const torch::Tensor flat = tensor.detach().to(torch::kFloat32).contiguous().view(-1);
  return {flat.data_ptr<float>(), flat.data_ptr<float>() + flat.numel()};
}

struct Folded {
  std::vector<float> weights;
  std::vector<float> bias;
};

/// y = gamma (w x - mean) / sqrt(var + eps) + beta as one set of weights.
template <typename Norm>
Folded fold(const torch::Tensor& weights, const Norm& norm) {
  const torch::Tensor scale = norm->weight / torch::sqrt(norm->running_var + norm->options.eps());
  std::vector<std::int64_t> shape(static_cast<std::size_t>(weights.dim()), 1);
  shape[0] = -1;
  return {.weights = numbers(weights * scale.view(shape)),
          .bias = numbers(norm->bias - norm->running_mean * scale)};
}

Convolution folded(const NormalisedConvolution& layer) {
  Folded result = fold(layer.convolution->weight, layer.norm);
  return {.plan = layer.plan,
          .relu = true,
          .weights = std::move(result.weights),
          .bias = std::move(result.bias)};
}

Residual folded(const NormalisedResidual& layer) {
  return {.first = folded(layer.first), .second = folded(layer.second)};
}

Linear folded(const NormalisedLinear& layer) {
  if (!layer.plan.hidden) {
    return {.plan = layer.plan,
            .weights = numbers(layer.linear->weight),
            .bias = numbers(layer.linear->bias)};
  }
  Folded result = fold(layer.linear->weight, layer.norm);
  return {.plan = layer.plan, .weights = std::move(result.weights), .bias = std::move(result.bias)};
}

torch::Tensor normalised(NormalisedConvolution& layer, const torch::Tensor& values) {
  return layer.norm->forward(layer.convolution->forward(values));
}

torch::Tensor pass(NormalisedConvolution& layer, const torch::Tensor& values) {
  return torch::relu(normalised(layer, values));
}

torch::Tensor pass(NormalisedResidual& layer, const torch::Tensor& values) {
  return torch::relu(values + normalised(layer.second, pass(layer.first, values)));
}

/// As a convolution over all cells at once: that runs in oneDNN on all threads, where a matrix
/// product would go to the system's BLAS, by default a slow one with a single thread.
torch::Tensor pass(NormalisedLinear& layer, const torch::Tensor& values) {
  const torch::Tensor cells = values.dim() > 2 ? values : values.view({values.size(0), -1, 1, 1});
  const torch::Tensor kernel =
      layer.linear->weight.view({layer.plan.outputs, cells.size(1), cells.size(2), cells.size(3)});
  const torch::Tensor result = torch::conv2d(cells, kernel, layer.linear->bias).flatten(1);
  return layer.plan.hidden ? torch::relu(layer.norm->forward(result)) : result;
}

}  // namespace

TorchNetwork::TorchNetwork(const NetworkPlan& plan) : plan_(plan) {
  for (const LayerPlan& layer : plan.layers) {
    if (const auto* convolution = std::get_if<ConvolutionPlan>(&layer)) {
      layers_.emplace_back(make(*convolution));
    } else if (const auto* residual = std::get_if<ResidualPlan>(&layer)) {
      const ConvolutionPlan each{residual->channels, residual->channels, 1};
      NormalisedConvolution first = make(each);
      layers_.emplace_back(NormalisedResidual{std::move(first), make(each)});
    } else {
      const LinearPlan& linear = std::get<LinearPlan>(layer);
      const std::string name = std::to_string(registered_++);
      NormalisedLinear made{
          .plan = linear,
          .linear = register_module(
              "linear" + name,
              torch::nn::Linear(
                  torch::nn::LinearOptions(linear.inputs, linear.outputs).bias(!linear.hidden)))};
      if (linear.hidden) {
        made.norm = register_module("norm" + name, torch::nn::BatchNorm1d(linear.outputs));
      }
      layers_.emplace_back(std::move(made));
    }
  }
}

NormalisedConvolution TorchNetwork::make(const ConvolutionPlan& plan) {
  const std::string name = std::to_string(registered_++);
  const auto options =
      torch::nn::Conv2dOptions(plan.inputs, plan.outputs, 3).stride(plan.stride).padding(1);
  return {
      .plan = plan,
      .convolution = register_module(
          "convolution" + name, torch::nn::Conv2d(torch::nn::Conv2dOptions(options).bias(false))),
      .norm = register_module("norm" + name, torch::nn::BatchNorm2d(plan.outputs))};
}

torch::Tensor TorchNetwork::forward(torch::Tensor values) {
  for (auto& layer : layers_) {
    values = std::visit([&](auto& one) { return pass(one, values); }, layer);
  }
  return values;
}

FoldedNetwork TorchNetwork::fold() const {
  FoldedNetwork network{.plan = plan_, .layers = {}};
  for (const auto& layer : layers_) {
    std::visit([&](const auto& one) { network.layers.emplace_back(folded(one)); }, layer);
  }
  return network;
}

void TorchNetwork::follow(const TorchNetwork& other, double share) {
  const torch::NoGradGuard no_gradients;
  const auto blend = [share](const std::vector<torch::Tensor>& mine,
                             const std::vector<torch::Tensor>& theirs) {
    for (std::size_t i = 0; i < mine.size(); ++i) {
      if (mine[i].is_floating_point()) {
        torch::Tensor(mine[i]).lerp_(theirs[i], share);
      } else {
        torch::Tensor(mine[i]).copy_(theirs[i]);
      }
    }
  };
  blend(parameters(), other.parameters());
  blend(buffers(), other.buffers());
}

}  // namespace sketchloc::detail
