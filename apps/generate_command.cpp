#include "apps/generate_command.hpp"

#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "apps/data_set_files.hpp"
#include "apps/generate_params.hpp"
#include "apps/given_drawing.hpp"
#include "apps/interrupt.hpp"
#include "apps/option_checks.hpp"
#include "apps/output_folder.hpp"
#include "apps/parallel.hpp"
#include "apps/parameter_options.hpp"
#include "apps/program.hpp"
#include "apps/progress.hpp"
#include "apps/read_options.hpp"
#include "apps/statistics_table.hpp"
#include "datasets/io/atomic_file.hpp"
#include "datasets/io/sketch_io.hpp"
#include "datasets/sim/data_set.hpp"
#include "datasets/sim/drawing_statistics.hpp"
#include "datasets/sim/scan_agreement.hpp"

namespace sketchloc {
namespace {

namespace fs = std::filesystem;

enum class PersonKind { Human, Tps, None };

const std::map<std::string, BuildingKind> kBuildingKinds = {{"home", BuildingKind::Home},
                                                            {"office", BuildingKind::Office},
                                                            {"warehouse", BuildingKind::Warehouse}};
const std::map<std::string, PersonKind> kPersonKinds = {
    {"human", PersonKind::Human}, {"tps", PersonKind::Tps}, {"none", PersonKind::None}};

struct GenerateOptions {
  std::string kind = "office";
  std::string person = "human";
  fs::path map;
  std::optional<double> cell_m;
  fs::path drawing;
  SketchReading reading;  ///< of the drawing, or without one of the map
  std::vector<fs::path> correspondences;
  std::uint64_t seed = 1;
  std::size_t count = 1;
  fs::path out;
  bool force = false;
  bool statistics = false;
  unsigned jobs = 0;
  ParameterOptions parameters;
};

GenerateParams parameters_of(const GenerateOptions& options) {
  GenerateParams defaults;
  defaults.person =
      kPersonKinds.at(options.person) == PersonKind::Tps ? tps_person() : human_person();
  return parameters_from<GenerateParams>(options.parameters, defaults);
}

/// The map as cells with their size: from the file, or from --cell-m.
struct RealMap {
  Grid<std::uint8_t> occupied;
  double cell_m;
};

std::optional<RealMap> read_map(const GenerateOptions& options) {
  if (options.map.empty()) {
    return std::nullopt;
  }
  Sketch map =
      read_any_drawing(options.map, options.drawing.empty() ? options.reading : SketchReading{});
  if (!map.px_per_m && !options.cell_m) {
    throw std::invalid_argument(options.map.string() +
                                ": a picture has no scale; give --cell-m, the side of a pixel in "
                                "metres, or a map_server YAML file");
  }
  return RealMap{std::move(map.occupied),
                 options.cell_m.value_or(1.0 / map.px_per_m.value_or(1.0))};
}

/// One data set per seed, in a generated building or in the real one.
class Generator {
 public:
  explicit Generator(const GenerateOptions& options)
      : options_(options), params_(parameters_of(options)), map_(read_map(options)) {
    if (!options.drawing.empty()) {
      given_ = read_given_drawing(options.drawing, options.reading, options.correspondences,
                                  building_of(options.seed).map);
    }
  }

  DataSet make(std::uint64_t seed) const {
    throw_if_interrupted();
    const DataSetParams params = data_set_params();
    if (!map_) {
      return generate_data_set(params, seed);
    }
    const Building building = building_of(seed);
    DataSetInBuilding made = given_ ? generate_data_set(building, given_->drawing, params, seed)
                                    : generate_data_set(building, params, seed);
    require_made(made.status);
    DataSet data_set = *std::move(made.data_set);
    if (given_) {
      data_set.reference =
          with_support(std::move(data_set.reference), given_->fit, data_set.world_from_robot);
    }
    return data_set;
  }

  void write(const fs::path& folder, std::uint64_t seed) const {
    const DataSet data_set = make(seed);
    write_data_set(folder, data_set, description(seed));
    if (given_) {
      write_atomically(folder / "reference.yaml", to_yaml(support_of(data_set, given_->fit)));
    }
  }

  RunDescription description(std::uint64_t seed) const {
    RunDescription made_by{
        .command = "generate", .seed = seed, .inputs = {}, .parameters = to_config(params_)};
    if (given_) {
      made_by.inputs.emplace_back("drawing", options_.drawing.string());
      for (const fs::path& csv : options_.correspondences) {
        made_by.inputs.emplace_back("correspondences", csv.string());
      }
    } else {
      made_by.inputs.emplace_back("person", options_.person);
    }
    for (const auto& [option, value] : given_drawing_options(options_.reading)) {
      made_by.inputs.emplace_back(option, value);
    }
    if (map_) {
      made_by.inputs.emplace_back("map", options_.map.string());
      made_by.inputs.emplace_back("cell-m", to_config(map_->cell_m).text);
    } else {
      made_by.inputs.emplace_back("kind", options_.kind);
    }
    return made_by;
  }

 private:
  void require_made(DataSetInBuilding::Status status) const {
    const auto fail = [this](const char* what_to_do) {
      throw std::runtime_error(options_.map.string() + ": " + what_to_do);
    };
    switch (status) {
      case DataSetInBuilding::Status::Made:
        return;
      case DataSetInBuilding::Status::NoFreeSpace:
        return fail(
            "the robot fits nowhere in this map; check --cell-m, or give a smaller "
            "--drive.robot_radius_m or --map_reading.min_floor_m2");
      case DataSetInBuilding::Status::Confined:
        return fail(
            "the robot cannot drive from place to place in this map; check --cell-m, or "
            "give a smaller --drive.robot_radius_m");
      case DataSetInBuilding::Status::NothingToDraw:
        return fail(
            "nothing of this map is drawn; make --person.pen.left_out_share or "
            "--map_reading.min_wall_m smaller, or check --cell-m");
    }
  }

  DataSetParams data_set_params() const {
    const bool drawn = !given_ && kPersonKinds.at(options_.person) != PersonKind::None;
    return {.building = kBuildingKinds.at(options_.kind),
            .person = drawn ? std::optional(params_.person) : std::nullopt,
            .drive = params_.drive,
            .lidar = params_.lidar,
            .odometry = params_.odometry,
            .checkpoint = throw_if_interrupted};
  }

  Building building_of(std::uint64_t seed) const {
    Rng rng = make_rng(seed);
    try {
      return building_from_map(map_->occupied, map_->cell_m, rng, params_.map_reading);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(options_.map.string() + ": " + error.what() +
                                  "; check --cell-m, or give a larger --map_reading.max_side_m");
    }
  }

  const GenerateOptions& options_;
  GenerateParams params_;
  std::optional<RealMap> map_;
  std::optional<GivenDrawing> given_;
};

/// A single data set lies in the folder itself, several in folders named by their seeds.
void generate_files(const GenerateOptions& options) {
  if (options.out.empty()) {
    throw std::invalid_argument("generate needs --out DIR (or --statistics)");
  }
  const Generator generator(options);
  OutputFolder out(options.out, options.force);
  Progress progress("generate", options.count);
  const auto generate_one = [&](std::size_t index) {
    const std::uint64_t seed = options.seed + index;
    const fs::path folder = options.count == 1 ? out / "" : out / ("seed_" + std::to_string(seed));
    fs::create_directories(folder);
    generator.write(folder, seed);
  };
  work_in_parallel(options.count, options.jobs, generate_one,
                   [&](std::size_t done) { progress.update(done); });
  if (options.count > 1) {  // else it is there already
    RunDescription run = generator.description(options.seed);
    run.inputs.emplace_back("count", std::to_string(options.count));
    write_atomically(out / "run.yaml", run_file_text(run));
  }
  out.commit();
  std::cout << options.count << (options.count == 1 ? " data set in " : " data sets in ")
            << out.target().string() << "\n";
}

/// How the drawing draws the places that it is known for.
std::vector<DrawnPlace> scored_places(const DataSet& data_set) {
  std::vector<DrawnPlace> places =
      drawn_places(data_set.world_from_robot, data_set.drawing.sketch_from_world);
  std::vector<DrawnPlace> scored;
  for (const ReferencePose& pose : data_set.reference.poses) {
    if (pose.scored) {
      scored.push_back(places.at(pose.step));
    }
  }
  return scored;
}

MeasuredDrawing measure(const DataSet& data_set) {
  return {
      .distortion = measure_drawing(scored_places(data_set)),
      .agreement = measure_agreement(data_set.drawing.sketch, data_set.run, data_set.reference)};
}

void print_statistics(const GenerateOptions& options) {
  const Generator generator(options);
  std::vector<MeasuredDrawing> measured(options.count);
  Progress progress("measure", options.count);
  const auto measure_one = [&](std::size_t index) {
    measured[index] = measure(generator.make(options.seed + index));
  };
  work_in_parallel(options.count, options.jobs, measure_one,
                   [&](std::size_t done) { progress.update(done); });
  std::cout << statistics_table(measured);
}

void add_algorithm_options(CLI::App& command, GenerateOptions& options) {
  const auto option = [&](const std::string& flag, auto& value, const std::string& help) {
    return command.add_option(flag, value, help)->group(kAlgorithmGroup);
  };
  option("--kind", options.kind, "Building: home, office or warehouse")
      ->check(one_of(kBuildingKinds))
      ->capture_default_str();
  option("--person", options.person,
         "Who draws: human (as people do), tps (the plan under one thin plate spline) or none (the "
         "true map)")
      ->check(one_of(kPersonKinds))
      ->capture_default_str();
  option("--seed", options.seed, "Of the first data set; the next ones count on")
      ->check(whole_number())
      ->capture_default_str();
  option("--count", options.count, "Data sets to make")
      ->check(whole_number())
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
}

/// A real building, and maybe somebody's drawing of it.
void add_map_options(CLI::App& command, GenerateOptions& options) {
  const auto option = [&](const std::string& flag, auto& value, const std::string& help) {
    return command.add_option(flag, value, help)->group(kAlgorithmGroup);
  };
  CLI::Option* map =
      option("--map", options.map, "A real building's map instead: picture or map_server YAML")
          ->check(CLI::ExistingFile)
          ->type_name("FILE");
  option("--cell-m", options.cell_m, "Side of a pixel of --map in metres")
      ->check(positive_number());
  map->excludes(command.get_option("--kind"));
  CLI::Option* drawing = option("--drawing", options.drawing,
                                "Somebody's drawing of --map instead of a simulated person's")
                             ->check(CLI::ExistingFile)
                             ->needs(map)
                             ->type_name("FILE");
  CLI::Option* correspondences =
      option("--correspondences", options.correspondences,
             "Places found in --drawing and in the picture of --map; several files count together")
          ->check(CLI::ExistingFile)
          ->allow_extra_args(false)
          ->needs(drawing)
          ->type_name("PAIRS.csv");
  add_drawing_options(command, options.reading, "Of --drawing, or without it of --map");
  drawing->needs(correspondences)->excludes(command.get_option("--person"));
}

void add_output_options(CLI::App& command, GenerateOptions& options) {
  command.add_option("--out", options.out, "Folder for the data sets")
      ->type_name("DIR")
      ->group(kOutputGroup);
  command.add_flag("--force", options.force, "Replace an earlier result in --out")
      ->group(kOutputGroup);
  command
      .add_flag(
          "--statistics", options.statistics,
          "Print how the drawings distort the world and what that makes of the scans, instead of "
          "writing them")
      ->group(kOutputGroup);
  add_jobs_option(command, options.jobs);
}

}  // namespace

void add_generate_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "generate", "Simulate buildings, people who draw them, and robots that drive through them.");
  const auto options = std::make_shared<GenerateOptions>();
  add_algorithm_options(*command, *options);
  add_map_options(*command, *options);
  add_parameter_options(*command, to_config(GenerateParams{}), options->parameters);
  add_output_options(*command, *options);
  command->callback(
      [options] { options->statistics ? print_statistics(*options) : generate_files(*options); });
}

}  // namespace sketchloc
