#include "apps/train_command.hpp"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/interrupt.hpp"
#include "apps/parameter_options.hpp"
#include "apps/program.hpp"
#include "apps/progress.hpp"
#include "apps/read_bytes.hpp"
#include "apps/run_file.hpp"
#include "apps/training_curve.hpp"
#include "datasets/io/atomic_file.hpp"
#include "motion/angles.hpp"
#include "registration/network_predictor.hpp"
#include "registration/train/sample_source.hpp"
#include "registration/train/trainer.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

const std::map<std::string, NetworkKind> kNetworkKinds = {
    {"chen20", NetworkKind::Chen20}, {"affine", NetworkKind::Affine}, {"ours", NetworkKind::Ours}};

struct TrainParams {
  SampleSourceParams source;
  TrainerParams trainer;
  std::uint64_t improve_after = 300'000;  ///< samples; then ours improves its own priors
};

template <typename Visitor>
void visit_fields(TrainParams& params, Visitor&& visit) {
  visit("source", params.source);
  visit("trainer", params.trainer);
  visit("improve_after", params.improve_after);
}

struct TrainOptions {
  std::string network = "ours";
  std::uint64_t samples = 1'000'000;
  std::uint64_t stop_after = 0;
  std::uint64_t seed = 1;
  std::uint64_t validate_every = 50'000;
  int validation_batches = 16;
  fs::path out;
  bool resume = false;
  bool force = false;
  int threads = 2;
  int workers = 1;
  ParameterOptions parameters;
};

std::string bytes_of(const fs::path& file) {
  std::optional<std::string> bytes = read_bytes(file);
  if (!bytes) {
    throw std::runtime_error(file.string() + ": cannot be read");
  }
  return *std::move(bytes);
}

TrainParams parameters_of(const TrainOptions& options) {
  const auto params = parameters_from<TrainParams>(options.parameters);
  if (params.source.sample.cells % 32 != 0) {
    throw std::invalid_argument("source.sample.cells must be a multiple of 32, is " +
                                std::to_string(params.source.sample.cells));
  }
  return params;
}

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

/// One sitting of learning, from the last checkpoint to the end or to Ctrl-C.
class Training {
 public:
  explicit Training(const TrainOptions& options)
      : options_(options),
        kind_(kNetworkKinds.at(options.network)),
        params_(parameters_of(options)),
        total_batches_(batches_of(options.samples)),
        trainer_({.kind = kind_,
                  .window = params_.source.sample.window(),
                  .seed = options.seed,
                  .total_batches = total_batches_},
                 params_.trainer),
        curve_(curve_header()) {}

  void run() {
    open_folder();
    validation_ = make_validation();
    sitting_start_ = Clock::now();
    try {
      learn();
    } catch (const Interrupted&) {
      save();
      throw Interrupted("interrupted; go on with --resume");
    }
  }

 private:
  std::uint64_t batches_of(std::uint64_t samples) const {
    const auto batch = static_cast<std::uint64_t>(params_.source.batch);
    return std::max<std::uint64_t>(1, (samples + batch - 1) / batch);
  }

  SampleSource::Stream stream(SampleSplit split, std::uint64_t first_batch) const {
    return {.kind = input_of(kind_),
            .split = split,
            .seed = split == SampleSplit::Training ? options_.seed : 0,
            .first_batch = first_batch};
  }

  /// Whether the curve's last point before so many batches is late enough.
  bool improves_priors(std::uint64_t batches) const {
    const std::uint64_t every = batches_of(options_.validate_every);
    const std::uint64_t last_point =
        batches / every * every * static_cast<std::uint64_t>(params_.source.batch);
    return kind_ == NetworkKind::Ours && last_point > 0 && last_point >= params_.improve_after;
  }

  /// Priors are improved by the network of the curve's last point, so that going on from a
  /// checkpoint gives the same samples as never having stopped.
  std::unique_ptr<SampleSource> training_samples() const {
    SampleSource::Stream from = stream(SampleSplit::Training, trainer_.batches_learned());
    if (improves_priors(trainer_.batches_learned())) {
      from.improving_network = bytes_of(options_.out / "network.onnx");
    }
    return std::make_unique<SampleSource>(params_.source, from, options_.workers);
  }

  /// The same for all networks and seeds, in buildings of its own.
  std::vector<SampleBatch> make_validation() const {
    SampleSourceParams params = params_.source;
    params.samples_per_scene = std::max(1, params.batch / params.scenes);  // many buildings
    SampleSource source(params, stream(SampleSplit::Validation, 0),
                        options_.threads + options_.workers - 1);
    std::vector<SampleBatch> batches;
    for (int i = 0; i < options_.validation_batches; ++i) {
      batches.push_back(source.next());
      throw_if_interrupted();
    }
    return batches;
  }

  void open_folder() {
    const bool begun = fs::exists(options_.out / "checkpoint.pt");
    if (begun && options_.resume) {
      trainer_.restore(bytes_of(options_.out / "checkpoint.pt"));
      const fs::path curve = options_.out / "curve.csv";
      curve_ = curve_until(fs::exists(curve) ? bytes_of(curve) : "", samples_learned());
      seconds_before_ = seconds_of_curve(curve_);
      spdlog::info("go on after {} samples", samples_learned());
      return;
    }
    if (!options_.force && fs::exists(options_.out) && !fs::is_empty(options_.out)) {
      throw std::invalid_argument(options_.out.string() +
                                  " is not empty; give --resume to go on, or --force");
    }
    fs::create_directories(options_.out);
    write_atomically(
        options_.out / "run.yaml",
        run_file_text({.command = "train",
                       .seed = options_.seed,
                       .inputs = {{"network", options_.network},
                                  {"samples", std::to_string(options_.samples)},
                                  {"validate-every", std::to_string(options_.validate_every)},
                                  {"threads", std::to_string(options_.threads)}},
                       .parameters = to_config(params_)}));
  }

  std::uint64_t samples_learned() const {
    return trainer_.batches_learned() * static_cast<std::uint64_t>(params_.source.batch);
  }

  void learn() {
    std::unique_ptr<SampleSource> source = training_samples();
    const std::uint64_t last = options_.stop_after == 0
                                   ? total_batches_
                                   : std::min(total_batches_, batches_of(options_.stop_after));
    const std::uint64_t every = batches_of(options_.validate_every);
    Progress progress("train", last);
    while (trainer_.batches_learned() < last) {
      loss_.add(trainer_.learn(source->next()));
      const std::uint64_t done = trainer_.batches_learned();
      if (done % every == 0 || done == total_batches_) {
        record();
      } else if (done == last) {
        save();  // no point of the curve: its network goes on improving priors
      }
      if (done % every == 0 && done < last && improves_priors(done)) {
        source = training_samples();
      }
      progress.update(done);
    }
  }

  void save() const { write_atomically(options_.out / "checkpoint.pt", trainer_.checkpoint()); }

  /// The checkpoint comes last: a curve may be ahead of it, never behind.
  void record() {
    const std::chrono::duration<double> sitting = Clock::now() - sitting_start_;
    const CurvePoint point{.samples = samples_learned(),
                           .seconds = seconds_before_ + sitting.count(),
                           .loss = loss_.take(),
                           .validation = trainer_.validate(validation_)};
    curve_ += curve_row(point);
    write_atomically(options_.out / "curve.csv", curve_);
    if (const std::string picture = curve_svg(curve_); !picture.empty()) {
      write_atomically(options_.out / "curve.svg", picture);
    }
    write_atomically(options_.out / "network.onnx", onnx_bytes(trainer_.folded()));
    save();
    spdlog::info("{} samples: loss {:.4f}, median {:.1f} cm {:.2f} deg, mean {:.1f} cm {:.2f} deg",
                 point.samples, point.loss.total, 100.0 * point.validation.position_m.median,
                 deg_from_rad(point.validation.heading_rad.median),
                 100.0 * point.validation.position_m.mean,
                 deg_from_rad(point.validation.heading_rad.mean));
  }

  const TrainOptions& options_;
  NetworkKind kind_;
  TrainParams params_;
  std::uint64_t total_batches_;
  Trainer trainer_;
  std::string curve_;
  MeanLoss loss_;
  double seconds_before_ = 0.0;
  Clock::time_point sitting_start_;
  std::vector<SampleBatch> validation_;
};

void add_algorithm_options(CLI::App& command, TrainOptions& options) {
  const auto option = [&](const std::string& flag, auto& value, const std::string& help) {
    return command.add_option(flag, value, help)->group(kAlgorithmGroup)->capture_default_str();
  };
  const std::map<std::string, std::uint64_t> units = {{"k", 1'000}, {"M", 1'000'000}};
  const auto count = [&](const std::string& flag, std::uint64_t& value, const std::string& help) {
    option(flag, value, help)
        ->transform(CLI::AsNumberWithUnit(units, CLI::AsNumberWithUnit::CASE_SENSITIVE, "N[k|M]"));
  };
  option("--network", options.network, "chen20, affine or ours")
      ->check(CLI::IsMember(&kNetworkKinds));
  count("--samples", options.samples, "To learn from in all");
  count("--stop-after", options.stop_after, "End this sitting there; 0: at --samples");
  option("--seed", options.seed, "Of the samples and of the network's first numbers");
  count("--validate-every", options.validate_every,
        "Samples between points of the curve, each with a checkpoint");
  option("--validation-batches", options.validation_batches, "From buildings never learned from")
      ->check(CLI::Range(1, 10'000));
}

void add_output_options(CLI::App& command, TrainOptions& options) {
  command.add_option("--out", options.out, "Folder for checkpoint.pt, network.onnx and curve.csv")
      ->required()
      ->type_name("DIR")
      ->group(kOutputGroup);
  command.add_flag("--force", options.force, "Begin anew in a folder that is not empty")
      ->group(kOutputGroup);
  command
      .add_flag("--resume", options.resume, "Go on from the checkpoint in --out, if there is one")
      ->group(kOutputGroup);
  command.add_option("--threads", options.threads, "That learn; part of what makes the result")
      ->check(CLI::Range(1, 256))
      ->group(kUsabilityGroup)
      ->capture_default_str();
  command.add_option("--workers", options.workers, "Threads that make samples")
      ->check(CLI::Range(1, 256))
      ->group(kUsabilityGroup)
      ->capture_default_str();
}

}  // namespace

void add_train_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("train", "Train a network for registration in the simulator.");
  const auto options = std::make_shared<TrainOptions>();
  add_algorithm_options(*command, *options);
  add_parameter_options(*command, to_config(TrainParams{}), options->parameters);
  add_output_options(*command, *options);
  command->callback([options] {
    set_learning_threads(options->threads);
    run_networks_on_one_thread();
    Training(*options).run();
    std::cout << "trained network in " << options->out.string() << "\n";
  });
}

}  // namespace sketchloc
