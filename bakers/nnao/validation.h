// The error of a network on points of scenes that no training used.
#pragma once

#include <vector>

#include "bakers/nnao/dataset.h"
#include "sdk/src/nnao/network.h"

namespace nook::bake::nnao {

struct ValidationRow {
  std::uint32_t taps = 0;
  double mse = 0;  // for one pixel's AO before the blur
  // For the mean over the noise values: the error after a perfect filter over 3 x 3 pixels.
  double mse_blurred = 0;
  // The mean of AO minus reference after this filter, where the reference is below 0.35.
  double dark_bias = 0;
  // Median angle from the reference in degrees, where its AO is below 0.7. One is for the bent normal, as the
  // mean over the noise values, and one for the normal.
  double bent_angle = 0, normal_angle = 0;
};

// Evaluates every stride-th point. Threads share the work, and the result does not depend on their number.
ValidationRow validate(const nook::nnao::Network& network, const Dataset& data, std::uint32_t taps,
                       std::size_t stride = 1);
// The same without mse_blurred, which costs 9 times as much.
double validation_mse(const nook::nnao::Network& network, const Dataset& data, std::uint32_t taps,
                      std::size_t stride = 1);

// Returns the error of the constant predictor, the mean AO of the training points.
double constant_mse(const Dataset& data);

}  // namespace nook::bake::nnao
