// Measures the error of a network on points of scenes that were not used in training.
#pragma once

#include <vector>

#include "bakers/nnao/dataset.h"
#include "sdk/src/nnao/network.h"

namespace nook::bake::nnao {

struct ValidationRow {
  std::uint32_t taps = 0;
  double mse = 0;  // error of the AO of single pixels, before the blur
  // Mean squared error of the mean over the noise values. This is the error after a perfect filter over 3 x 3
  // pixels.
  double mse_blurred = 0;
  // Mean of AO minus reference AO after this filter, over points whose reference AO is below 0.35.
  double dark_bias = 0;
  // Median angles from the reference bent normal in degrees, over points whose reference AO is below 0.7: for
  // the bent normal (mean over the noise values), and for the plain normal as a baseline.
  double bent_angle = 0, normal_angle = 0;
};

// Evaluates every `stride`-th point in parallel. The result does not depend on the number of threads.
ValidationRow validate(const nook::nnao::Network& network, const Dataset& data, std::uint32_t taps,
                       std::size_t stride = 1);
// Returns only `mse`. This is 9 times as fast, because mse_blurred evaluates every noise value.
double validation_mse(const nook::nnao::Network& network, const Dataset& data, std::uint32_t taps,
                      std::size_t stride = 1);

// Returns the mean squared error of a constant prediction: the mean AO of the training points.
double constant_mse(const Dataset& data);

}  // namespace nook::bake::nnao
