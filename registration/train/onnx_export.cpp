#include <onnx/onnx_pb.h>

#include <initializer_list>
#include <string>

#include "registration/correlation.hpp"
#include "registration/network_input.hpp"
#include "registration/train/network_plan.hpp"

namespace sketchloc {
namespace {

/// Appends nodes one after the other; every node's output has a name of its own.
class GraphWriter {
 public:
  explicit GraphWriter(onnx::GraphProto& graph) : graph_(graph) {}

  const std::string& last() const { return last_; }

  void convolve(const Convolution& layer, bool with_relu) {
    const ConvolutionPlan& plan = layer.plan;
    onnx::NodeProto& node = append("Conv", {last_});
    add_weights(node, layer.weights, {plan.outputs, plan.inputs, 3, 3}, layer.bias);
    add_integers(node, "kernel_shape", {3, 3});
    add_integers(node, "strides", {plan.stride, plan.stride});
    add_integers(node, "pads", {1, 1, 1, 1});
    if (with_relu) {
      append("Relu", {last_});
    }
  }

  void add(const Residual& layer) {
    const std::string before = last_;
    convolve(layer.first, true);
    convolve(layer.second, false);
    append("Add", {before, last_});
    append("Relu", {last_});
  }

  void add(const Convolution& layer) { convolve(layer, layer.relu); }

  void add(const Encoder& layer) {
    add(layer.first);
    add(layer.second);
    add(layer.third);
  }

  void add(const Match& layer) {
    last_ = kScanInput;
    add(layer.scan);
    const std::string scan = last_;
    last_ = kDrawingInput;
    add(layer.drawing);
    append(kMatchOperation, {scan, last_}).set_domain(kOperationDomain);
  }

  void add(const Linear& layer) {
    if (!flat_) {
      append("Flatten", {last_});
      flat_ = true;
    }
    onnx::NodeProto& node = append("Gemm", {last_});
    add_weights(node, layer.weights, {layer.plan.outputs, layer.plan.inputs}, layer.bias);
    add_integer(node, "transB", 1);
    if (layer.plan.hidden) {
      append("Relu", {last_});
    }
  }

  /// Gives the last node's output the name of the graph's.
  void finish(const std::string& output) {
    graph_.mutable_node(graph_.node_size() - 1)->set_output(0, output);
    last_ = output;
  }

 private:
  onnx::NodeProto& append(const std::string& operation, std::initializer_list<std::string> inputs) {
    const std::string name = operation + "_" + std::to_string(graph_.node_size());
    onnx::NodeProto& node = *graph_.add_node();
    node.set_op_type(operation);
    node.set_name(name);
    for (const std::string& input : inputs) {
      node.add_input(input);
    }
    node.add_output(name);
    last_ = name;
    return node;
  }

  void add_weights(onnx::NodeProto& node, const std::vector<float>& weights,
                   std::initializer_list<int> shape, const std::vector<float>& bias) {
    node.add_input(add_tensor(node.name() + "_weights", weights, shape));
    node.add_input(add_tensor(node.name() + "_bias", bias, {static_cast<int>(bias.size())}));
  }

  const std::string& add_tensor(const std::string& name, const std::vector<float>& values,
                                std::initializer_list<int> shape) {
    onnx::TensorProto& tensor = *graph_.add_initializer();
    tensor.set_name(name);
    tensor.set_data_type(onnx::TensorProto::FLOAT);
    for (const int size : shape) {
      tensor.add_dims(size);
    }
    // little endian, as all processors that we run on
    tensor.set_raw_data(values.data(), values.size() * sizeof(float));
    return tensor.name();
  }

  static void add_integer(onnx::NodeProto& node, const std::string& name, int value) {
    onnx::AttributeProto& attribute = *node.add_attribute();
    attribute.set_name(name);
    attribute.set_type(onnx::AttributeProto::INT);
    attribute.set_i(value);
  }

  static void add_integers(onnx::NodeProto& node, const std::string& name,
                           std::initializer_list<int> values) {
    onnx::AttributeProto& attribute = *node.add_attribute();
    attribute.set_name(name);
    attribute.set_type(onnx::AttributeProto::INTS);
    for (const int value : values) {
      attribute.add_ints(value);
    }
  }

  onnx::GraphProto& graph_;
  std::string last_ = kStackedInput;
  bool flat_ = false;
};

void describe(onnx::ValueInfoProto& value, const std::string& name,
              std::initializer_list<int> shape) {
  value.set_name(name);
  onnx::TypeProto::Tensor& tensor = *value.mutable_type()->mutable_tensor_type();
  tensor.set_elem_type(onnx::TensorProto::FLOAT);
  for (const int size : shape) {
    tensor.mutable_shape()->add_dim()->set_dim_value(size);
  }
}

}  // namespace

std::string onnx_bytes(const FoldedNetwork& network) {
  onnx::ModelProto model;
  model.set_ir_version(7);
  model.set_producer_name("sketchloc");
  model.add_opset_import()->set_version(11);
  onnx::OperatorSetIdProto& own_operations = *model.add_opset_import();
  own_operations.set_domain(kOperationDomain);
  own_operations.set_version(1);
  onnx::GraphProto& graph = *model.mutable_graph();
  graph.set_name("registration");
  const NetworkPlan& plan = network.plan;
  const auto describe_input = [&](const char* name, int channels) {
    describe(*graph.add_input(), name, {1, channels, plan.cells, plan.cells});
  };
  if (const auto* match = std::get_if<MatchPlan>(&plan.layers.front())) {
    describe_input(kScanInput, match->scan_channels);
    describe_input(kDrawingInput, match->drawing_channels);
  } else {
    describe_input(kStackedInput, plan.channels);
  }
  describe(*graph.add_output(), "output", {1, plan.outputs});
  GraphWriter writer(graph);
  for (const auto& layer : network.layers) {
    std::visit([&](const auto& one) { writer.add(one); }, layer);
  }
  writer.finish("output");
  return model.SerializeAsString();
}

}  // namespace sketchloc
