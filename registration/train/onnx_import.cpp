#include <onnx/onnx_pb.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <span>
#include <stdexcept>
#include <string>

#include "registration/train/network_plan.hpp"

namespace sketchloc {
namespace {

[[noreturn]] void refuse(const std::string& why) {
  throw std::runtime_error("not a network of this kind: " + why);
}

std::vector<float> values_of(const onnx::TensorProto& tensor) {
  const std::string& raw = tensor.raw_data();
  if (tensor.data_type() != onnx::TensorProto::FLOAT || raw.size() % sizeof(float) != 0) {
    refuse(tensor.name() + " is not of 32 bit numbers");
  }
  std::vector<float> values(raw.size() / sizeof(float));
  std::memcpy(values.data(), raw.data(), raw.size());  // little endian, as it is written
  return values;
}

/// Deals out the numbers of the graph's layers in their order.
class GraphReader {
 public:
  explicit GraphReader(const onnx::GraphProto& graph) : graph_(graph) {
    for (const onnx::TensorProto& tensor : graph.initializer()) {
      tensors_[tensor.name()] = &tensor;
    }
  }

  Convolution read(const ConvolutionPlan& plan) {
    const onnx::NodeProto& node = next("Conv");
    const std::size_t inputs = static_cast<std::size_t>(plan.inputs) * 9;
    return {.plan = plan,
            .relu = true,
            .weights = tensor(node, 1, inputs * static_cast<std::size_t>(plan.outputs)),
            .bias = tensor(node, 2, static_cast<std::size_t>(plan.outputs))};
  }

  Residual read(const ResidualPlan& plan) {
    const ConvolutionPlan each{plan.channels, plan.channels, 1};
    Convolution first = read(each);
    return {.first = std::move(first), .second = read(each)};
  }

  Match read(const MatchPlan& plan) {
    Encoder scan = read_encoder(plan.scan_channels, plan);
    return {.plan = plan,
            .scan = std::move(scan),
            .drawing = read_encoder(plan.drawing_channels, plan)};
  }

  Linear read(const LinearPlan& plan) {
    const onnx::NodeProto& node = next("Gemm");
    const auto outputs = static_cast<std::size_t>(plan.outputs);
    return {.plan = plan,
            .weights = tensor(node, 1, outputs * static_cast<std::size_t>(plan.inputs)),
            .bias = tensor(node, 2, outputs)};
  }

  void expect_end() {
    if (node_ = next_layer(); node_ != graph_.node_size()) {
      refuse("it has more layers");
    }
  }

 private:
  Encoder read_encoder(int inputs, const MatchPlan& plan) {
    Convolution first = read(ConvolutionPlan{inputs, plan.first_width, 2});
    Convolution second = read(ConvolutionPlan{plan.first_width, plan.width, 2});
    return {std::move(first), std::move(second), read(ResidualPlan{plan.width})};
  }

  /// Of the nodes from here on, the first one that has numbers.
  int next_layer() const {
    int node = node_;
    while (node < graph_.node_size() && graph_.node(node).op_type() != "Conv" &&
           graph_.node(node).op_type() != "Gemm") {
      ++node;
    }
    return node;
  }

  const onnx::NodeProto& next(const std::string& operation) {
    node_ = next_layer();
    if (node_ == graph_.node_size()) {
      refuse("it has fewer layers");
    }
    const onnx::NodeProto& node = graph_.node(node_++);
    if (node.op_type() != operation || node.input_size() != 3) {
      refuse(node.name() + " is not the layer " + operation + " that is expected there");
    }
    return node;
  }

  std::vector<float> tensor(const onnx::NodeProto& node, int input, std::size_t size) const {
    const auto found = tensors_.find(node.input(input));
    if (found == tensors_.end()) {
      refuse(node.input(input) + " is missing");
    }
    std::vector<float> values = values_of(*found->second);
    if (values.size() != size) {
      refuse(node.input(input) + " has " + std::to_string(values.size()) + " numbers instead of " +
             std::to_string(size));
    }
    return values;
  }

  const onnx::GraphProto& graph_;
  std::map<std::string, const onnx::TensorProto*> tensors_;
  int node_ = 0;
};

}  // namespace

FoldedNetwork network_of_onnx(const NetworkPlan& plan, const std::string& bytes) {
  onnx::ModelProto model;
  if (!model.ParseFromString(bytes)) {
    refuse("it is not an ONNX file");
  }
  GraphReader reader(model.graph());
  FoldedNetwork network{.plan = plan, .layers = {}};
  for (const LayerPlan& layer : plan.layers) {
    std::visit([&](const auto& one) { network.layers.emplace_back(reader.read(one)); }, layer);
  }
  reader.expect_end();
  return network;
}

}  // namespace sketchloc
