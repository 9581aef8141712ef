#include "apps/registration_task.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "apps/interrupt.hpp"
#include "apps/read_bytes.hpp"
#include "motion/angles.hpp"
#include "registration/train/trainer.hpp"

namespace sketchloc {
namespace {

constexpr double kCmPerM = 100.0;

/// Mean of the losses since the last point of the curve.
class MeanLoss {
 public:
  void add(const TrainingLoss& loss) {
    sum_.total += loss.total;
    sum_.grid += loss.grid;
    sum_.pose += loss.pose;
    sum_.spread += loss.spread;
    sum_.inlier += loss.inlier;
    ++count_;
  }
  TrainingLoss take() {
    const double share = 1.0 / std::max(count_, 1);
    const TrainingLoss mean{.total = share * sum_.total,
                            .grid = share * sum_.grid,
                            .pose = share * sum_.pose,
                            .spread = share * sum_.spread,
                            .inlier = share * sum_.inlier};
    *this = {};
    return mean;
  }

 private:
  TrainingLoss sum_;
  int count_ = 0;
};

std::optional<FoldedNetwork> trained(const RegistrationLearning& learning) {
  if (learning.from.empty()) {
    return std::nullopt;
  }
  const int cells = learning.source.sample.window().cells;
  return network_of_onnx(plan_network(learning.kind, cells), learning.from);
}

class RegistrationTask final : public LearningTask {
 public:
  RegistrationTask(const RegistrationLearning& learning, const LearningPlan& plan)
      : learning_(learning),
        plan_(plan),
        trainer_({.kind = learning.kind,
                  .window = learning.source.sample.window(),
                  .seed = plan.seed,
                  .total_batches = batches_of(plan.samples, learning.source.batch),
                  .from = trained(learning)},
                 plan.trainer) {}

  int samples_per_batch() const override { return learning_.source.batch; }
  std::uint64_t batches_learned() const override { return trainer_.batches_learned(); }

  /// Priors are improved by the network of the curve's last point (before it, by the one that this
  /// one goes on from), so that going on from a checkpoint gives the same samples as never having
  /// stopped.
  void go_on(const std::filesystem::path& point) override {
    const bool improves = improves_priors();
    if (source_ && !improves) {
      return;
    }
    SampleSource::Stream from = stream(SampleSplit::Training, trainer_.batches_learned());
    if (improves) {
      from.improving_network = last_point() > 0 ? bytes_of(point) : learning_.from;
    }
    source_.reset();  // its threads end before others begin
    source_ = std::make_unique<SampleSource>(learning_.source, from, plan_.workers);
  }

  void learn_batch() override { loss_.add(trainer_.learn(source_->next())); }

  std::vector<std::string_view> columns() const override {
    return {"loss",
            "loss_grid",
            "loss_pose",
            "loss_spread",
            "loss_inlier",
            "position_mean_cm",
            "position_median_cm",
            "position_p90_cm",
            "heading_mean_deg",
            "heading_median_deg",
            "heading_p90_deg",
            "failures",
            "prior_position_median_cm",
            "prior_heading_median_deg"};
  }

  Measured measure() override {
    if (validation_.empty()) {
      make_validation();
    }
    const TrainingLoss loss = loss_.take();
    const ValidationReport report = trainer_.validate(validation_);
    const ValidationSummary& position = report.position_m;
    const ValidationSummary& heading = report.heading_rad;
    return {.columns = {loss.total, loss.grid, loss.pose, loss.spread, loss.inlier,
                        kCmPerM * position.mean, kCmPerM * position.median, kCmPerM * position.p90,
                        deg_from_rad(heading.mean), deg_from_rad(heading.median),
                        deg_from_rad(heading.p90), static_cast<double>(report.failures),
                        kCmPerM * report.prior_position_m.median,
                        deg_from_rad(report.prior_heading_rad.median)},
            .summary =
                fmt::format("loss {:.4f}, median {:.1f} cm {:.2f} deg, mean {:.1f} cm {:.2f} deg",
                            loss.total, kCmPerM * position.median, deg_from_rad(heading.median),
                            kCmPerM * position.mean, deg_from_rad(heading.mean))};
  }

  std::vector<CurvePanel> panels() const override {
    return {{.title = "Median position error",
             .column = "position_median_cm",
             .top_column = "prior_position_median_cm",
             .unit = "cm"},
            {.title = "Median heading error",
             .column = "heading_median_deg",
             .top_column = "prior_heading_median_deg",
             .unit = "deg"}};
  }

  std::string checkpoint() const override { return trainer_.checkpoint(); }
  void restore(const std::string& checkpoint) override { trainer_.restore(checkpoint); }
  std::string network() const override { return onnx_bytes(trainer_.folded()); }

 private:
  SampleSource::Stream stream(SampleSplit split, std::uint64_t first_batch) const {
    return {.kind = input_of(learning_.kind),
            .split = split,
            .seed = split == SampleSplit::Training ? plan_.seed : 0,
            .first_batch = first_batch};
  }

  /// After how many samples the curve has its last point; 0: it has none.
  std::uint64_t last_point() const {
    const std::uint64_t every = batches_of(plan_.validate_every, samples_per_batch());
    return trainer_.batches_learned() / every * every *
           static_cast<std::uint64_t>(samples_per_batch());
  }

  /// Whether there is a network that has learned enough to improve priors.
  bool improves_priors() const {
    const bool learned = last_point() > 0 && last_point() >= learning_.improve_after;
    return learning_.kind == NetworkKind::Ours && (learned || !learning_.from.empty());
  }

  /// The same for all networks and seeds, in buildings of its own.
  void make_validation() {
    SampleSourceParams params = learning_.source;
    params.samples_per_scene = std::max(1, params.batch / params.scenes);  // many buildings
    SampleSource source(params, stream(SampleSplit::Validation, 0),
                        plan_.threads + plan_.workers - 1);
    std::vector<SampleBatch> batches;
    for (int i = 0; i < plan_.validation_batches; ++i) {
      batches.push_back(source.next());
      throw_if_interrupted();
    }
    validation_ = std::move(batches);
  }

  RegistrationLearning learning_;
  LearningPlan plan_;
  Trainer trainer_;
  MeanLoss loss_;
  std::unique_ptr<SampleSource> source_;
  std::vector<SampleBatch> validation_;
};

}  // namespace

std::uint64_t batches_of(std::uint64_t samples, int samples_per_batch) {
  const auto batch = static_cast<std::uint64_t>(samples_per_batch);
  return std::max<std::uint64_t>(1, (samples + batch - 1) / batch);
}

std::unique_ptr<LearningTask> make_registration_task(const RegistrationLearning& learning,
                                                     const LearningPlan& plan) {
  return std::make_unique<RegistrationTask>(learning, plan);
}

}  // namespace sketchloc
