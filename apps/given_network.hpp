#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "eval/predictors.hpp"

namespace sketchloc {

/// The methods of registration by name.
const std::map<std::string, RegistrationMethod>& registration_methods();

/// A method of registration with the network of a file, or with the one that comes with the program
/// where `network` is empty. Throws std::invalid_argument where the two do not go together and
/// std::runtime_error where the file is no network, with advice.
std::unique_ptr<WarpPredictor> predictor_from(RegistrationMethod method,
                                              const std::filesystem::path& network,
                                              const NetworkPredictorParams& params);

}  // namespace sketchloc
