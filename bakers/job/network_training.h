// Training of a screen-space network, which a checkpoint continues, and its error.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "bakers/nnao/checkpoint.h"
#include "bakers/nnao/training.h"
#include "bakers/nnao/validation.h"
#include "sdk/src/nnao/network_file.h"

namespace nook::bake {

// Everything that the network's bits depend on beside the program itself, as one line of JSON.
std::string network_recipe(const nnao::DatasetSettings& data, const nnao::TrainingSettings& training);

// The error of the network on the points that no training saw: a row of the constant predictor, then one for
// each number of taps.
nlohmann::ordered_json validation_rows(const nook::nnao::Network& network, const nnao::Dataset& data);

}  // namespace nook::bake
