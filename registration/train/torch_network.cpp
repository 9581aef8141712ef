#include "registration/train/detail/torch_network.hpp"

#include <ATen/Parallel.h>

#include <cmath>
#include <span>
#include <string>
#include <utility>

#include "motion/check.hpp"
#include "registration/correlation.hpp"

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

/// Layer by layer: with its normalisation folded in where there is one.
template <typename Layer, typename Norm>
Folded folded_numbers(const Layer& layer, const Norm& norm) {
  return norm ? fold(layer->weight, norm)
              : Folded{.weights = numbers(layer->weight), .bias = numbers(layer->bias)};
}

Convolution folded(const NormalisedConvolution& layer) {
  Folded result = folded_numbers(layer.convolution, layer.norm);
  return {.plan = layer.plan,
          .relu = true,
          .weights = std::move(result.weights),
          .bias = std::move(result.bias)};
}

Residual folded(const NormalisedResidual& layer) {
  return {.first = folded(layer.first), .second = folded(layer.second)};
}

Linear folded(const NormalisedLinear& layer) {
  Folded result = folded_numbers(layer.linear, layer.norm);
  return {.plan = layer.plan, .weights = std::move(result.weights), .bias = std::move(result.bias)};
}

Match folded(const NormalisedMatch& layer) {
  const auto encoder = [](const NormalisedEncoder& one) {
    return Encoder{folded(one.first), folded(one.second), folded(one.third)};
  };
  return {.plan = layer.plan, .scan = encoder(layer.scan), .drawing = encoder(layer.drawing)};
}

void put(torch::Tensor target, const std::vector<float>& values) {
  check(target.numel() == static_cast<std::int64_t>(values.size()), "numbers of the same plan");
  const torch::NoGradGuard no_gradients;
  target.copy_(torch::from_blob(const_cast<float*>(values.data()), target.sizes()));
}

void put(NormalisedConvolution& layer, const Convolution& numbers) {
  put(layer.convolution->weight, numbers.weights);
  put(layer.convolution->bias, numbers.bias);
}

void put(NormalisedResidual& layer, const Residual& numbers) {
  put(layer.first, numbers.first);
  put(layer.second, numbers.second);
}

void put(NormalisedEncoder& layer, const Encoder& numbers) {
  put(layer.first, numbers.first);
  put(layer.second, numbers.second);
  put(layer.third, numbers.third);
}

void put(NormalisedMatch& layer, const Match& numbers) {
  put(layer.scan, numbers.scan);
  put(layer.drawing, numbers.drawing);
}

void put(NormalisedLinear& layer, const Linear& numbers) {
  put(layer.linear->weight, numbers.weights);
  put(layer.linear->bias, numbers.bias);
}

torch::Tensor normalised(NormalisedConvolution& layer, const torch::Tensor& values) {
  const torch::Tensor result = layer.convolution->forward(values);
  return layer.norm ? layer.norm->forward(result) : result;
}

torch::Tensor pass(NormalisedConvolution& layer, const torch::Tensor& values) {
  return torch::relu(normalised(layer, values));
}

torch::Tensor pass(NormalisedResidual& layer, const torch::Tensor& values) {
  return torch::relu(values + normalised(layer.second, pass(layer.first, values)));
}

torch::Tensor pass(NormalisedEncoder& layer, const torch::Tensor& values) {
  return pass(layer.third, pass(layer.second, pass(layer.first, values)));
}

FeatureShape shape_of(const torch::Tensor& features) {
  return {.channels = static_cast<int>(features.size(1)),
          .side = static_cast<int>(features.size(2))};
}

/// One sample's numbers of a contiguous tensor.
std::span<float> row(const torch::Tensor& tensor, std::int64_t index) {
  const auto size = static_cast<std::size_t>(tensor.numel() / tensor.size(0));
  return {tensor.data_ptr<float>() + static_cast<std::size_t>(index) * size, size};
}

template <typename Visit>
void for_each_sample(const torch::Tensor& tensor, Visit&& visit) {
  at::parallel_for(0, tensor.size(0), 1, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t sample = first; sample < last; ++sample) {
      visit(sample);
    }
  });
}

/// `correlate` with gradients.
class Correlation : public torch::autograd::Function<Correlation> {
 public:
  static torch::Tensor forward(torch::autograd::AutogradContext* context,
                               const torch::Tensor& scan_features,
                               const torch::Tensor& drawing_features) {
    const torch::Tensor scan = scan_features.contiguous();
    const torch::Tensor drawing = drawing_features.contiguous();
    context->save_for_backward({scan, drawing});
    const torch::Tensor result =
        torch::empty({scan.size(0), kCorrelationShifts, scan.size(2), scan.size(3)});
    for_each_sample(scan, [&](std::int64_t i) {
      correlate(shape_of(scan), row(scan, i), row(drawing, i), row(result, i));
    });
    return result;
  }

  static torch::autograd::tensor_list backward(torch::autograd::AutogradContext* context,
                                               const torch::autograd::tensor_list& gradients) {
    const torch::autograd::variable_list saved = context->get_saved_variables();
    const torch::Tensor gradient = gradients[0].contiguous();
    torch::Tensor to_scan = torch::empty_like(saved[0]);
    torch::Tensor to_drawing = torch::empty_like(saved[1]);
    for_each_sample(gradient, [&](std::int64_t i) {
      correlate_backwards(shape_of(saved[0]), row(saved[0], i), row(saved[1], i), row(gradient, i),
                          row(to_scan, i), row(to_drawing, i));
    });
    return {to_scan, to_drawing};
  }
};

torch::Tensor pass(NormalisedMatch& layer, const torch::Tensor& values) {
  const auto parts =
      values.split_with_sizes({layer.plan.scan_channels, layer.plan.drawing_channels}, 1);
  const torch::Tensor scan =
      pass(layer.scan, parts[0].contiguous(torch::MemoryFormat::ChannelsLast));
  const torch::Tensor drawing =
      pass(layer.drawing, parts[1].contiguous(torch::MemoryFormat::ChannelsLast));
  const torch::Tensor both = Correlation::apply(scan, drawing);
  return torch::cat({scan, drawing, both}, 1).contiguous(torch::MemoryFormat::ChannelsLast);
}

/// As a convolution over all cells at once: that runs in oneDNN on all threads, where a matrix
/// product would go to the system's BLAS, by default a slow one with a single thread.
torch::Tensor pass(NormalisedLinear& layer, const torch::Tensor& values) {
  const torch::Tensor cells = values.dim() > 2 ? values : values.view({values.size(0), -1, 1, 1});
  const torch::Tensor kernel =
      layer.linear->weight.view({layer.plan.outputs, cells.size(1), cells.size(2), cells.size(3)});
  const torch::Tensor result = torch::conv2d(cells, kernel, layer.linear->bias).flatten(1);
  if (!layer.plan.hidden) {
    return result;
  }
  return torch::relu(layer.norm ? layer.norm->forward(result) : result);
}

}  // namespace

TorchNetwork::TorchNetwork(const NetworkPlan& plan, bool normalise)
    : plan_(plan), normalise_(normalise) {
  for (const LayerPlan& layer : plan.layers) {
    std::visit([&](const auto& one) { layers_.emplace_back(make(one)); }, layer);
  }
}

TorchNetwork::TorchNetwork(const FoldedNetwork& folded) : TorchNetwork(folded.plan, false) {
  for (std::size_t i = 0; i < layers_.size(); ++i) {
    std::visit(
        [&](auto& layer) {
          using Numbers = decltype(detail::folded(layer));
          put(layer, std::get<Numbers>(folded.layers.at(i)));
        },
        layers_[i]);
  }
}

NormalisedConvolution TorchNetwork::make(const ConvolutionPlan& plan) {
  const std::string name = std::to_string(registered_++);
  const auto options = torch::nn::Conv2dOptions(plan.inputs, plan.outputs, 3)
                           .stride(plan.stride)
                           .padding(1)
                           .bias(!normalise_);
  NormalisedConvolution made{
      .plan = plan,
      .convolution = register_module("convolution" + name, torch::nn::Conv2d(options))};
  if (normalise_) {
    made.norm = register_module("norm" + name, torch::nn::BatchNorm2d(plan.outputs));
  }
  return made;
}

NormalisedLinear TorchNetwork::make(const LinearPlan& plan) {
  const std::string name = std::to_string(registered_++);
  const bool normalised = normalise_ && plan.hidden;
  const auto options = torch::nn::LinearOptions(plan.inputs, plan.outputs).bias(!normalised);
  NormalisedLinear made{.plan = plan,
                        .linear = register_module("linear" + name, torch::nn::Linear(options))};
  if (normalised) {
    made.norm = register_module("norm" + name, torch::nn::BatchNorm1d(plan.outputs));
  }
  return made;
}

NormalisedMatch TorchNetwork::make(const MatchPlan& plan) {
  NormalisedEncoder scan = make_encoder(plan.scan_channels, plan);
  return {plan, std::move(scan), make_encoder(plan.drawing_channels, plan)};
}

NormalisedResidual TorchNetwork::make(const ResidualPlan& plan) {
  const ConvolutionPlan each{plan.channels, plan.channels, 1};
  NormalisedConvolution first = make(each);
  return {std::move(first), make(each)};
}

NormalisedEncoder TorchNetwork::make_encoder(int inputs, const MatchPlan& plan) {
  NormalisedConvolution first = make(ConvolutionPlan{inputs, plan.first_width, 2});
  NormalisedConvolution second = make(ConvolutionPlan{plan.first_width, plan.width, 2});
  return {std::move(first), std::move(second), make(ResidualPlan{plan.width})};
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
