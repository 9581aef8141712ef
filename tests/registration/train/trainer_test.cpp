#include "registration/train/trainer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/dnn.hpp>
#include <stdexcept>

#include "registration/detail/match_layer.hpp"
#include "registration/network_output.hpp"

namespace sketchloc {
namespace {

const SampleParams kSample{.cells = 32};

const std::vector<SampleBatch>& batches(InputKind kind) {
  const auto make = [](InputKind of_kind) {
    const SampleSourceParams params{
        .scene = {.home_share = 1.0, .office_share = 0.0, .drive_m = 10.0},
        .sample = kSample,
        .scenes = 4,
        .samples_per_scene = 64,
        .batch = 32};
    SampleSource source(params, {.kind = of_kind, .seed = 5}, 1);
    std::vector<SampleBatch> made;
    for (int i = 0; i < 4; ++i) {
      made.push_back(source.next());
    }
    return made;
  };
  static const std::vector<SampleBatch> residual = make(InputKind::Residual);
  static const std::vector<SampleBatch> published = make(InputKind::Published);
  return kind == InputKind::Residual ? residual : published;
}

class TrainerOf : public ::testing::TestWithParam<NetworkKind> {
 protected:
  TrainerOf() { set_learning_threads(1); }

  Trainer::Plan plan(std::uint64_t total_batches = 8) const {
    return {
        .kind = GetParam(), .window = kSample.window(), .seed = 3, .total_batches = total_batches};
  }
  const std::vector<SampleBatch>& data() const { return batches(input_of(GetParam())); }

  void learn(Trainer& trainer, std::size_t first, std::size_t last) const {
    for (std::size_t i = first; i < last; ++i) {
      trainer.learn(data()[i % data().size()]);
    }
  }
};

TEST_P(TrainerOf, LearnsTheSameFromTheSame) {
  Trainer one(plan(), TrainerParams{});
  Trainer other(plan(), TrainerParams{});
  learn(one, 0, 3);
  learn(other, 0, 3);
  EXPECT_EQ(one.predict(data()[3]), other.predict(data()[3]));
}

TEST_P(TrainerOf, GoesOnFromACheckpointAsIfItHadNeverStopped) {
  Trainer whole(plan(), TrainerParams{});
  learn(whole, 0, 3);
  Trainer resumed(plan(), TrainerParams{});
  resumed.restore(whole.checkpoint());
  EXPECT_EQ(resumed.batches_learned(), 3U);
  learn(whole, 3, 6);
  learn(resumed, 3, 6);
  EXPECT_EQ(whole.predict(data()[3]), resumed.predict(data()[3]));
}

TEST_P(TrainerOf, GetsBetterAtWhatItSees) {
  Trainer trainer(plan(60), {.warm_up_batches = 0});
  const double before = trainer.learn(data()[0]).total;
  double after = before;
  for (int i = 0; i < 59; ++i) {
    after = trainer.learn(data()[0]).total;
  }
  EXPECT_LT(after, 0.6 * before);
}

TEST_P(TrainerOf, ExportsWhatOpenCvComputesTheSame) {
  Trainer trainer(plan(), TrainerParams{});
  learn(trainer, 0, 4);
  const std::string onnx = onnx_bytes(trainer.folded());
  detail::register_match_layer();
  cv::dnn::Net network = cv::dnn::readNetFromONNX(onnx.data(), onnx.size());
  const SampleBatch& batch = data()[0];
  const std::vector<float> expected = trainer.predict(batch);
  const int channels = channels_of(input_of(GetParam()));
  const auto matches = GetParam() == NetworkKind::Ours;
  const int scan_channels = matches ? scan_channels_of(input_of(GetParam())) : 0;
  for (const int count : {1, 4}) {
    const std::vector<int> shape = {count, channels, kSample.cells, kSample.cells};
    const cv::Mat stacked(shape, CV_32F, const_cast<float*>(batch.input.data()));
    const auto part = [&](int from, int to) {
      return stacked({cv::Range::all(), cv::Range(from, to), cv::Range::all(), cv::Range::all()})
          .clone();
    };
    if (matches) {
      network.setInput(part(0, scan_channels), kScanInput);
    }
    network.setInput(part(scan_channels, channels), matches ? kDrawingInput : kStackedInput);
    const cv::Mat output = network.forward();
    ASSERT_EQ(output.total() * static_cast<std::size_t>(batch.count),
              expected.size() * static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < output.total(); ++i) {
      EXPECT_NEAR(output.ptr<float>()[i], expected[i], 1e-4);
    }
  }
}

TEST_P(TrainerOf, GoesOnFromANetworkThatWasExported) {
  Trainer first(plan(), TrainerParams{});
  learn(first, 0, 4);
  Trainer::Plan from = plan();
  from.from = network_of_onnx(plan_network(GetParam(), kSample.cells), onnx_bytes(first.folded()));
  Trainer second(from, TrainerParams{});
  const std::vector<float> expected = first.predict(data()[3]);
  const std::vector<float> begun = second.predict(data()[3]);
  ASSERT_EQ(begun.size(), expected.size());
  for (std::size_t i = 0; i < begun.size(); ++i) {
    EXPECT_NEAR(begun[i], expected[i], 1e-4);
  }
  Trainer resumed(from, TrainerParams{});
  learn(second, 0, 2);
  resumed.restore(second.checkpoint());
  EXPECT_EQ(resumed.predict(data()[3]), second.predict(data()[3]));
  EXPECT_NE(second.predict(data()[3]), begun);
}

TEST_P(TrainerOf, RefusesToGoOnFromWhatIsNotOfItsKind) {
  const std::string bytes = onnx_bytes(Trainer(plan(), TrainerParams{}).folded());
  const NetworkKind other =
      GetParam() == NetworkKind::Ours ? NetworkKind::Chen20 : NetworkKind::Ours;
  EXPECT_THROW(network_of_onnx(plan_network(other, kSample.cells), bytes), std::runtime_error);
  const NetworkPlan own = plan_network(GetParam(), kSample.cells);
  EXPECT_THROW(network_of_onnx(own, "no network"), std::runtime_error);
  EXPECT_THROW(network_of_onnx(own, ""), std::runtime_error);
}

TEST(VerificationNetwork, BeginsWithWhatOursSaysOfBeingRight) {
  const FoldedNetwork ours =
      Trainer({.kind = NetworkKind::Ours, .window = kSample.window(), .seed = 3}, TrainerParams{})
          .folded();
  const FoldedNetwork begun =
      network_of_onnx(plan_verification(kSample.cells), onnx_bytes(verification_of(ours)));
  const auto& last = std::get<Linear>(begun.layers.back());
  const auto& last_of_ours = std::get<Linear>(ours.layers.back());
  const auto inputs = static_cast<std::size_t>(last.plan.inputs);
  const std::size_t logit = static_cast<std::size_t>(ResidualOutput::kInlierLogit);
  ASSERT_EQ(last.weights.size(), 2 * inputs);
  for (std::size_t i = 0; i < inputs; ++i) {
    EXPECT_FLOAT_EQ(last.weights[inputs + i] - last.weights[i],
                    last_of_ours.weights[logit * inputs + i]);
  }
  EXPECT_FLOAT_EQ(last.bias[1] - last.bias[0], last_of_ours.bias[logit]);
  EXPECT_EQ(std::get<Linear>(begun.layers[begun.layers.size() - 2]).weights,
            std::get<Linear>(ours.layers[ours.layers.size() - 2]).weights);
}

TEST_P(TrainerOf, JudgesByPoses) {
  Trainer trainer(plan(), TrainerParams{});
  const ValidationReport report = trainer.validate(data());
  EXPECT_EQ(report.samples, 128);
  EXPECT_GT(report.prior_position_m.median, 0.1);
  EXPECT_TRUE(std::isfinite(report.position_m.mean));
  EXPECT_LE(report.position_m.median, report.position_m.p90);
}

INSTANTIATE_TEST_SUITE_P(Kinds, TrainerOf,
                         ::testing::Values(NetworkKind::Chen20, NetworkKind::Affine,
                                           NetworkKind::Ours));

TEST(Trainer, RefusesACheckpointOfAnotherNetwork) {
  const Trainer::Plan ours{.window = kSample.window()};
  const Trainer::Plan published{.kind = NetworkKind::Chen20, .window = kSample.window()};
  Trainer trainer(ours, {});
  EXPECT_THROW(trainer.restore(Trainer(published, {}).checkpoint()), std::runtime_error);
  EXPECT_THROW(trainer.restore("not a checkpoint"), std::runtime_error);
}

TEST(Trainer, RefusesParametersOutOfRange) {
  EXPECT_NO_THROW(validate(TrainerParams{}));
  EXPECT_THROW(validate(TrainerParams{.learning_rate = 0.0}), std::invalid_argument);
  EXPECT_THROW(validate(TrainerParams{.averaging = 1.0}), std::invalid_argument);
}

}  // namespace
}  // namespace sketchloc
