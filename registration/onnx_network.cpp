#include "registration/onnx_network.hpp"

#include <array>
#include <mutex>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn/dnn.hpp>
#include <optional>
#include <stdexcept>

#include "registration/detail/match_layer.hpp"

namespace sketchloc {
namespace {

/// OpenCV warns of every operation that is not its own, and prints what it throws too. Its log
/// level is the whole process's, so one at a time.
class SilentOpenCv {
 public:
  SilentOpenCv()
      : alone_(mutex()),
        before_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {}
  ~SilentOpenCv() { cv::utils::logging::setLogLevel(before_); }
  SilentOpenCv(const SilentOpenCv&) = delete;
  SilentOpenCv& operator=(const SilentOpenCv&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex mutex;
    return mutex;
  }

  std::lock_guard<std::mutex> alone_;
  cv::utils::logging::LogLevel before_;
};

cv::dnn::Net read_network(std::span<const std::uint8_t> onnx) {
  detail::register_match_layer();
  cv::dnn::Net network =
      cv::dnn::readNetFromONNX(reinterpret_cast<const char*>(onnx.data()), onnx.size());
  network.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
  return network;
}

}  // namespace

struct OnnxNetwork::Implementation {
  cv::dnn::Net network;
  bool proven = false;  ///< has run once: what it throws is news no more

  cv::Mat run(std::span<const NetworkPlanes> inputs) {
    for (const NetworkPlanes& planes : inputs) {
      const auto each = static_cast<std::size_t>(planes.channels) *
                        static_cast<std::size_t>(planes.cells) *
                        static_cast<std::size_t>(planes.cells);
      const std::array<int, 4> shape = {static_cast<int>(planes.values.size() / each),
                                        planes.channels, planes.cells, planes.cells};
      // setInput copies; cv::Mat has no view of constant numbers.
      network.setInput(cv::Mat(4, shape.data(), CV_32F, const_cast<float*>(planes.values.data())),
                       planes.input);
    }
    return network.forward();
  }
};

OnnxNetwork::OnnxNetwork(std::span<const std::uint8_t> onnx)
    : implementation_(std::make_unique<Implementation>()) {
  try {
    const SilentOpenCv silent;
    implementation_->network = read_network(onnx);
  } catch (const cv::Exception& error) {
    throw std::runtime_error(error.what());
  }
}

OnnxNetwork::~OnnxNetwork() = default;
OnnxNetwork::OnnxNetwork(OnnxNetwork&&) noexcept = default;
OnnxNetwork& OnnxNetwork::operator=(OnnxNetwork&&) noexcept = default;

std::vector<float> OnnxNetwork::run(std::span<const NetworkPlanes> inputs) {
  try {
    std::optional<SilentOpenCv> silent;
    if (!implementation_->proven) {
      silent.emplace();
    }
    const cv::Mat output = implementation_->run(inputs);
    implementation_->proven = true;
    return {output.ptr<float>(), output.ptr<float>() + output.total()};
  } catch (const cv::Exception& error) {
    throw std::runtime_error(error.what());
  }
}

}  // namespace sketchloc
