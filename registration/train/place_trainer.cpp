#include "registration/train/place_trainer.hpp"

#include "motion/check.hpp"
#include "registration/network_input.hpp"
#include "registration/train/detail/learner.hpp"
#include "topology/place_classifier.hpp"
#include "topology/place_comparator.hpp"

namespace sketchloc {
namespace {

constexpr double kMargin = 1.0;  ///< different places lie at least so far apart

NetworkPlan label_plan(int cells) {
  constexpr int kChannels = scan_channels_of(InputKind::Residual);
  const int left = cells / 16;
  return {
      .channels = kChannels,
      .cells = cells,
      .outputs = kPlaceLabels,
      .layers = {ConvolutionPlan{kChannels, 16, 2}, ConvolutionPlan{16, 32, 2}, ResidualPlan{32},
                 ConvolutionPlan{32, 64, 2}, ResidualPlan{64}, ConvolutionPlan{64, 64, 2},
                 LinearPlan{64 * left * left, 64, true}, LinearPlan{64, kPlaceLabels, false}}};
}

/// [Topo20]: hidden layers of 70 and 90, 8 outputs.
NetworkPlan comparator_plan() {
  return {.channels = kComparatorInputs,
          .cells = 1,
          .outputs = kComparatorOutputs,
          .layers = {LinearPlan{kComparatorInputs, 70, true}, LinearPlan{70, 90, true},
                     LinearPlan{90, kComparatorOutputs, false}}};
}

/// How far apart the two nodes of each pair are taken.
torch::Tensor distances(const torch::Tensor& output) {
  const auto halves = output.chunk(2);
  return torch::sqrt((halves[0] - halves[1]).square().sum(1) + 1e-12);
}

torch::Tensor contrastive_loss(const torch::Tensor& output, const torch::Tensor& same) {
  const torch::Tensor apart = distances(output);
  const torch::Tensor too_near = torch::relu(kMargin - apart);
  return (same * apart.square() + (1 - same) * too_near.square()).mean();
}

torch::Tensor answers_of(const PlaceBatch& batch) {
  return torch::from_blob(const_cast<std::int64_t*>(batch.answer.data()), {batch.count},
                          torch::kInt64);
}

detail::Learner learner_of(const PlaceTrainer::Plan& plan, const NetworkPlan& network,
                           const TrainerParams& params) {
  const detail::Learner::Course course{.seed = plan.seed, .total_batches = plan.total_batches};
  return plan.from ? detail::Learner(*plan.from, params, course)
                   : detail::Learner(network, params, course);
}

}  // namespace

NetworkPlan plan_network(PlaceTask task, int cells) {
  if (task == PlaceTask::SamePlace) {
    check(cells == 1, "nodes are four numbers");
    return comparator_plan();
  }
  if (task == PlaceTask::Verification) {
    return plan_verification(cells);
  }
  check(cells > 0 && cells % 16 == 0, "the input is halved four times");
  return label_plan(cells);
}

class PlaceTrainer::Implementation {
 public:
  Implementation(const Plan& plan, const TrainerParams& params)
      : plan_(plan),
        network_(plan_network(plan.task, plan.cells)),
        learner_(learner_of(plan, network_, params)) {}

  double learn(const PlaceBatch& batch) {
    return learner_.learn(input_of(batch), [&](const torch::Tensor& output) {
      const torch::Tensor answers = answers_of(batch);
      return plan_.task == PlaceTask::SamePlace
                 ? contrastive_loss(output, answers.to(torch::kFloat32))
                 : torch::cross_entropy_loss(output, answers);
    });
  }

  ConfusionMatrix validate(std::span<const PlaceBatch> batches) {
    const std::size_t kinds = plan_.task == PlaceTask::Labels ? kPlaceLabels : 2;
    ConfusionMatrix confusion(kinds);
    for (const PlaceBatch& batch : batches) {
      const std::vector<std::size_t> given = answers(batch);
      for (std::size_t i = 0; i < given.size(); ++i) {
        confusion.add(static_cast<std::size_t>(batch.answer[i]), given[i]);
      }
    }
    return confusion;
  }

  detail::Learner& learner() { return learner_; }

 private:
  torch::Tensor input_of(const PlaceBatch& batch) const {
    const std::int64_t each = network_.channels * network_.cells * network_.cells;
    return detail::view(batch.input, {std::ssize(batch.input) / each, network_.channels,
                                      network_.cells, network_.cells})
        .contiguous(torch::MemoryFormat::ChannelsLast);
  }

  std::vector<std::size_t> answers(const PlaceBatch& batch) {
    std::vector<float> output = learner_.predict(input_of(batch));
    const torch::Tensor rows =
        detail::view(output, {std::ssize(output) / network_.outputs, network_.outputs});
    const torch::Tensor given = plan_.task == PlaceTask::SamePlace
                                    ? (distances(rows) < 0.5 * kMargin).to(torch::kInt64)
                                    : rows.argmax(1);
    const auto* begin = given.data_ptr<std::int64_t>();
    return {begin, begin + given.numel()};
  }

  Plan plan_;
  NetworkPlan network_;
  detail::Learner learner_;
};

PlaceTrainer::PlaceTrainer(const Plan& plan, const TrainerParams& params) {
  sketchloc::validate(params);
  check(plan.total_batches > 0, "there is something to learn");
  implementation_ = std::make_unique<Implementation>(plan, params);
}

PlaceTrainer::~PlaceTrainer() = default;

double PlaceTrainer::learn(const PlaceBatch& batch) { return implementation_->learn(batch); }
std::uint64_t PlaceTrainer::batches_learned() const {
  return implementation_->learner().batches_learned();
}
ConfusionMatrix PlaceTrainer::validate(std::span<const PlaceBatch> batches) const {
  return implementation_->validate(batches);
}
std::string PlaceTrainer::checkpoint() const { return implementation_->learner().checkpoint(); }
void PlaceTrainer::restore(const std::string& checkpoint) {
  implementation_->learner().restore(checkpoint);
}
FoldedNetwork PlaceTrainer::folded() const { return implementation_->learner().folded(); }

}  // namespace sketchloc
