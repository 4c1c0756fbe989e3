// The error of a trained network on the points that no training saw, as rows of a report.
#pragma once

#include <nlohmann/json.hpp>

#include "bakers/nnao/validation.h"

namespace nook::measure {

// A row of the constant predictor, then one for each number of taps.
nlohmann::ordered_json validation_rows(const nook::nnao::Network& network, const bake::nnao::Dataset& data);

}  // namespace nook::measure
