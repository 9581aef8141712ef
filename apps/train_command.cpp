#include "apps/train_command.hpp"

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/parameter_options.hpp"
#include "apps/place_task.hpp"
#include "apps/program.hpp"
#include "apps/read_bytes.hpp"
#include "apps/registration_task.hpp"
#include "apps/training_sitting.hpp"
#include "registration/network_predictor.hpp"
#include "registration/train/trainer.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, NetworkKind> kRegistrationKinds = {
    {"chen20", NetworkKind::Chen20}, {"affine", NetworkKind::Affine}, {"ours", NetworkKind::Ours}};

constexpr const char* kPlaces = "places";
constexpr const char* kSamePlace = "same-place";
constexpr const char* kVerify = "verify";

struct TrainParams {
  SampleSourceParams source;  ///< of the networks that register and verify
  PlaceSampleParams places;   ///< of the network that tells kinds of places
  NodePairParams same_place;  ///< of the one that compares places
  TrainerParams trainer;
  std::uint64_t improve_after = 300'000;  ///< samples; then ours improves its own priors
};

template <typename Visitor>
void visit_fields(TrainParams& params, Visitor&& visit) {
  visit("source", params.source);
  visit("places", params.places);
  visit("same_place", params.same_place);
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
  fs::path from;
  fs::path out;
  bool resume = false;
  bool force = false;
  int threads = 2;
  int workers = 1;
  ParameterOptions parameters;
};

LearningPlan learning_plan(const TrainOptions& options, const TrainParams& params) {
  return {.seed = options.seed,
          .samples = options.samples,
          .validate_every = options.validate_every,
          .validation_batches = options.validation_batches,
          .threads = options.threads,
          .workers = options.workers,
          .trainer = params.trainer};
}

void require_halvings(const char* name, int cells, int divisor) {
  if (cells % divisor != 0) {
    throw std::invalid_argument(std::string(name) + " must be a multiple of " +
                                std::to_string(divisor) + ", is " + std::to_string(cells));
  }
}

std::string trained_network(const fs::path& file) {
  return file.empty() ? std::string() : bytes_of(file);
}

std::unique_ptr<LearningTask> task_of(const TrainOptions& options, const TrainParams& params) {
  const LearningPlan plan = learning_plan(options, params);
  if (!options.from.empty() && !kRegistrationKinds.contains(options.network)) {
    throw std::invalid_argument("--from is for chen20, affine and ours; " + options.network +
                                " begins anew");
  }
  if (options.network == kPlaces) {
    require_halvings("places.look.window.cells", params.places.look.window.cells, 16);
    return make_label_task(params.places, plan);
  }
  if (options.network == kSamePlace) {
    return make_same_place_task(params.same_place, plan);
  }
  require_halvings("source.sample.cells", params.source.sample.cells, 32);
  if (options.network == kVerify) {
    return make_verification_task(params.source, plan);
  }
  try {
    return make_registration_task({.kind = kRegistrationKinds.at(options.network),
                                   .source = params.source,
                                   .improve_after = params.improve_after,
                                   .from = trained_network(options.from)},
                                  plan);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(options.from.string() + ": " + error.what());
  }
}

TrainingSittingPlan sitting_plan(const TrainOptions& options, const TrainParams& params) {
  return {.out = options.out,
          .made_by = {.command = "train",
                      .seed = options.seed,
                      .inputs = {{"network", options.network},
                                 {"from", options.from.string()},
                                 {"samples", std::to_string(options.samples)},
                                 {"validate-every", std::to_string(options.validate_every)},
                                 {"threads", std::to_string(options.threads)}},
                      .parameters = to_config(params)},
          .samples = options.samples,
          .stop_after = options.stop_after,
          .validate_every = options.validate_every,
          .resume = options.resume,
          .force = options.force};
}

std::vector<std::string> network_names() {
  std::vector<std::string> names = {kPlaces, kSamePlace, kVerify};
  for (const auto& [name, kind] : kRegistrationKinds) {
    names.push_back(name);
  }
  return names;
}

void add_algorithm_options(CLI::App& command, TrainOptions& options) {
  const auto option = [&](const std::string& flag, auto& value, const std::string& help) {
    return command.add_option(flag, value, help)->group(kAlgorithmGroup)->capture_default_str();
  };
  const std::map<std::string, std::uint64_t> units = {{"k", 1'000}, {"M", 1'000'000}};
  const auto count = [&](const std::string& flag, std::uint64_t& value, const std::string& help) {
    option(flag, value, help)
        ->transform(CLI::AsNumberWithUnit(units, CLI::AsNumberWithUnit::CASE_SENSITIVE, "N[k|M]"));
  };
  option("--network", options.network,
         "chen20, affine or ours: register scans; verify: tells whether the robot is where ours "
         "registered it; places: tells kinds of places; same-place: compares places")
      ->check(CLI::IsMember(network_names()));
  command
      .add_option("--from", options.from,
                  "network.onnx of that kind to go on from, with a new course of the learning rate")
      ->check(CLI::ExistingFile)
      ->type_name("FILE")
      ->group(kAlgorithmGroup);
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
  CLI::App* command = program.add_subcommand(
      "train", "Train a network in the simulator: for registration or topology.");
  const auto options = std::make_shared<TrainOptions>();
  add_algorithm_options(*command, *options);
  add_parameter_options(*command, to_config(TrainParams{}), options->parameters);
  add_output_options(*command, *options);
  command->callback([options] {
    set_learning_threads(options->threads);
    run_networks_on_one_thread();
    const auto params = parameters_from<TrainParams>(options->parameters);
    learn_in_folder(*task_of(*options, params), sitting_plan(*options, params));
    std::cout << "trained network in " << options->out.string() << "\n";
  });
}

}  // namespace sketchloc
