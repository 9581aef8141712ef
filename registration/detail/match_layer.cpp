#include "registration/detail/match_layer.hpp"

#include <algorithm>
#include <opencv2/dnn/dnn.hpp>
#include <opencv2/dnn/layer.hpp>
#include <string>
#include <vector>

#include "motion/check.hpp"
#include "registration/correlation.hpp"

namespace sketchloc::detail {
namespace {

class MatchLayer final : public cv::dnn::Layer {
 public:
  explicit MatchLayer(const cv::dnn::LayerParams& params) : Layer(params) {}

  static cv::Ptr<cv::dnn::Layer> create(cv::dnn::LayerParams& params) {
    return cv::makePtr<MatchLayer>(params);
  }

  bool getMemoryShapes(const std::vector<cv::dnn::MatShape>& inputs, int /*required_outputs*/,
                       std::vector<cv::dnn::MatShape>& outputs,
                       std::vector<cv::dnn::MatShape>& /*internals*/) const override {
    check(inputs.size() == 2 && inputs[0].size() == 4 && inputs[1].size() == 4 &&
              (inputs[0][0] == 1 || inputs[0][0] == inputs[1][0]) &&
              std::equal(inputs[0].begin() + 1, inputs[0].end(), inputs[1].begin() + 1),
          "maps of features of one shape, of one scan or of one for each drawing");
    outputs = {{inputs[1][0], 2 * inputs[1][1] + kCorrelationShifts, inputs[1][2], inputs[1][3]}};
    return false;  // not in place
  }

  void forward(cv::InputArrayOfArrays inputs_array, cv::OutputArrayOfArrays outputs_array,
               cv::OutputArrayOfArrays /*internals*/) override {
    std::vector<cv::Mat> inputs;
    std::vector<cv::Mat> outputs;
    inputs_array.getMatVector(inputs);
    outputs_array.getMatVector(outputs);
    const FeatureShape shape{.channels = inputs[1].size[1], .side = inputs[1].size[2]};
    const auto size = static_cast<std::size_t>(shape.size());
    const auto result_size = static_cast<std::size_t>(kCorrelationShifts * shape.cells());
    for (int sample = 0; sample < inputs[1].size[0]; ++sample) {
      const float* scan = inputs[0].ptr<float>(inputs[0].size[0] == 1 ? 0 : sample);
      const float* drawing = inputs[1].ptr<float>(sample);
      float* out = outputs[0].ptr<float>(sample);
      out = std::copy_n(scan, size, out);
      out = std::copy_n(drawing, size, out);
      correlate(shape, {scan, size}, {drawing, size}, {out, result_size});
    }
  }
};

}  // namespace

void register_match_layer() {
  static const bool registered = [] {
    const std::string name = std::string(kOperationDomain) + "." + kMatchOperation;
    cv::dnn::LayerFactory::registerLayer(name, MatchLayer::create);
    return true;
  }();
  (void)registered;
}

}  // namespace sketchloc::detail
