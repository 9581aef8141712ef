#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/ablate_suites.hpp"
#include "eval/filter_trials.hpp"

namespace sketchloc {

/// What a suite of whole runs does: every method on every set, with every seed where it draws.
struct FilterPlan {
  /// One run: what one thread does in one go.
  struct Piece {
    std::size_t task = 0;
    std::size_t method = 0;
    std::uint64_t seed = 1;
  };

  AblateParams params;
  std::vector<LocalizationMethod> methods;
  std::vector<FilterTask> tasks;
  std::vector<Piece> pieces;                                     ///< in the order of the results
  std::map<RegistrationMethod, std::filesystem::path> networks;  ///< that were given

  /// "SET, METHOD, SEED"
  std::string name_of(const Piece& piece) const;

  std::unique_ptr<WarpPredictor> predictor(RegistrationMethod method) const;
};

/// Reads the recorded runs. Throws where anything that was given makes no sense, so that it is said
/// now and not after the first drives.
FilterPlan filter_plan(const AblateOptions& options);

/// What results depend on beside the options: the contents of program, networks and recorded runs.
std::string fingerprints_of(const AblateOptions& options, const FilterPlan& plan);

/// Does pieces of a plan, one after the other; remembers the last set and the predictors. One for
/// each thread.
class FilterWorker {
 public:
  /// The plan must outlive the worker.
  explicit FilterWorker(const FilterPlan& plan) : plan_(plan) {}

  FilterTrial run(const FilterPlan::Piece& piece);

 private:
  const FilterData& data_of(std::size_t task);
  WarpPredictor* predictor_of(const LocalizationMethod& method);

  const FilterPlan& plan_;
  std::optional<std::size_t> task_;  ///< whose data are there
  FilterData data_;
  std::map<RegistrationMethod, std::unique_ptr<WarpPredictor>> predictors_;
};

}  // namespace sketchloc
