// Training of a screen-space network, which a checkpoint continues.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "bakers/nnao/checkpoint.h"
#include "bakers/nnao/training.h"
#include "sdk/src/nnao/network_file.h"

namespace nook::bake {

// Everything that the network's bits depend on beside the program itself, as one line of JSON.
std::string network_recipe(const nnao::DatasetSettings& data, const nnao::TrainingSettings& training);

}  // namespace nook::bake
