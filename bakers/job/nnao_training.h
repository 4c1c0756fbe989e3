// Trains the network and the specular occlusion that screen-space passes embed.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "bakers/nnao/specular_fit.h"
#include "bakers/nnao/training.h"
#include "bakers/nnao/validation.h"
#include "sdk/src/nnao/network_file.h"

namespace nook::bake {

// Returns one line of JSON with everything that determines the network's bits, except the program itself.
std::string network_recipe(const nnao::DatasetSettings& data, const nnao::TrainingSettings& training);

// Returns the error of the network on points that were not used for training: one row for a constant
// predictor, then one row for each tap count.
nlohmann::ordered_json validation_rows(const nook::nnao::Network& network, const nnao::Dataset& data);

// Fits specular occlusion to samples and writes the header that shaders and the runtime include.

struct SpecularTraining {
  std::string header;
  nnao::SpecularError error;  // measured on the validation samples
  std::size_t training_points = 0, validation_points = 0;
};

// Traces samples, and fits specular occlusion to them with the embedded network. To stop, return false from
// `progress`. The function then throws Failure(CANCELLED). The result has the same bits with any number of
// threads.
SpecularTraining train_specular(const nnao::SpecularFitSettings& settings,
                                const nnao::DatasetProgress& progress);

}  // namespace nook::bake
