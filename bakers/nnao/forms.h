// The parts of training that depend on the network's form: the parameters as one array, their initial values,
// their gradient over a minibatch, and the conversion to a network.
#pragma once

#include <span>
#include <vector>

#include "bakers/nnao/training.h"

namespace nook::bake::nnao {

// The parameters are in the order of nnao/layers.h.
std::size_t horizon_parameter_count();
void start_horizon(std::span<float> parameters, Random& random);
// Sets negative thresholds to 0. Call it after each step.
void constrain_horizon(std::span<float> parameters);
void export_horizon(std::span<const float> parameters, nook::nnao::HorizonNetwork& network);

// Computes the gradient of the mean loss over one minibatch. The number of points must be a multiple of 16.
// Random draws depend only on step_seed. Returns the loss.
double horizon_step_gradient(const Dataset& data, const TrainingSettings& settings,
                             std::span<const float> parameters, std::span<const std::uint32_t> points,
                             std::uint64_t step_seed, std::span<float> gradient);

// The parameters begin with the filters, one unit after another (unit, cell, input). The rest is in the order
// of nnao/layers.h.
std::size_t paper_parameter_count();
void start_paper(std::span<float> parameters, float mean_ao, Random& random);

// Mean and inverse standard deviation of each input of the grid. The inverse deviation of a constant input is
// 0.
struct PaperNormalisation {
  std::vector<float> mean, inverse_deviation;
};
PaperNormalisation paper_normalisation(const Dataset& data);
void export_paper(std::span<const float> parameters, const PaperNormalisation& normalisation,
                  nook::nnao::PaperNetwork& network);

// Does the same as horizon_step_gradient, for the paper form. The number of points may be arbitrary.
double paper_step_gradient(const Dataset& data, const PaperNormalisation& normalisation,
                           const TrainingSettings& settings, std::span<const float> parameters,
                           std::span<const std::uint32_t> points, std::uint64_t step_seed,
                           std::span<float> gradient);

}  // namespace nook::bake::nnao
