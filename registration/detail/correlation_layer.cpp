#include "registration/detail/correlation_layer.hpp"

#include <opencv2/dnn/dnn.hpp>
#include <opencv2/dnn/layer.hpp>
#include <string>
#include <vector>

#include "motion/check.hpp"
#include "registration/correlation.hpp"

namespace sketchloc::detail {
namespace {

class CorrelationLayer final : public cv::dnn::Layer {
 public:
  explicit CorrelationLayer(const cv::dnn::LayerParams& params) : Layer(params) {}

  static cv::Ptr<cv::dnn::Layer> create(cv::dnn::LayerParams& params) {
    return cv::makePtr<CorrelationLayer>(params);
  }

  bool getMemoryShapes(const std::vector<cv::dnn::MatShape>& inputs, int /*required_outputs*/,
                       std::vector<cv::dnn::MatShape>& outputs,
                       std::vector<cv::dnn::MatShape>& /*internals*/) const override {
    check(inputs.size() == 2 && inputs[0].size() == 4 && inputs[0] == inputs[1],
          "two maps of features of one shape");
    outputs = {{inputs[0][0], kCorrelationShifts, inputs[0][2], inputs[0][3]}};
    return false;  // not in place
  }

  void forward(cv::InputArrayOfArrays inputs_array, cv::OutputArrayOfArrays outputs_array,
               cv::OutputArrayOfArrays /*internals*/) override {
    std::vector<cv::Mat> inputs;
    std::vector<cv::Mat> outputs;
    inputs_array.getMatVector(inputs);
    outputs_array.getMatVector(outputs);
    const FeatureShape shape{.channels = inputs[0].size[1], .side = inputs[0].size[2]};
    const auto size = static_cast<std::size_t>(shape.size());
    const auto result_size = static_cast<std::size_t>(kCorrelationShifts * shape.cells());
    for (int sample = 0; sample < inputs[0].size[0]; ++sample) {
      correlate(shape, {inputs[0].ptr<float>(sample), size}, {inputs[1].ptr<float>(sample), size},
                {outputs[0].ptr<float>(sample), result_size});
    }
  }
};

}  // namespace

void register_correlation_layer() {
  static const bool registered = [] {
    const std::string name = std::string(kOperationDomain) + "." + kCorrelationOperation;
    cv::dnn::LayerFactory::registerLayer(name, CorrelationLayer::create);
    return true;
  }();
  (void)registered;
}

}  // namespace sketchloc::detail
