// The parts of training that depend on the network's form: its numbers as one array, their initial values,
// their gradient over a minibatch, and the conversion to a network.
#pragma once

#include <span>
#include <vector>

#include "bakers/nnao/training.h"

namespace nook::bake::nnao {

// The numbers are in the order of nnao/layers.h.
std::size_t horizon_parameter_count();
void start_horizon(std::span<float> parameters, Random& random);
// Moves thresholds below 0 to 0, after a step.
void constrain_horizon(std::span<float> parameters);
void export_horizon(std::span<const float> parameters, nook::nnao::HorizonNetwork& network);

// Computes the gradient of the mean loss over one minibatch, a multiple of 16 points. Random draws depend on
// step_seed. Returns the loss.
double horizon_step_gradient(const Dataset& data, const TrainingSettings& settings,
                             std::span<const float> parameters, std::span<const std::uint32_t> points,
                             std::uint64_t step_seed, std::span<float> gradient);

// The numbers are the filters, one unit after another (unit, cell, input), then the rest in the order of
// nnao/layers.h.
std::size_t paper_parameter_count();
void start_paper(std::span<float> parameters, float mean_ao, Random& random);

// Mean and inverse deviation of each input of the grid; a constant input has inverse deviation 0.
struct PaperNormalisation {
  std::vector<float> mean, inverse_deviation;
};
PaperNormalisation paper_normalisation(const Dataset& data);
void export_paper(std::span<const float> parameters, const PaperNormalisation& normalisation,
                  nook::nnao::PaperNetwork& network);

// The counterpart of horizon_step_gradient, for any number of points.
double paper_step_gradient(const Dataset& data, const PaperNormalisation& normalisation,
                           const TrainingSettings& settings, std::span<const float> parameters,
                           std::span<const std::uint32_t> points, std::uint64_t step_seed,
                           std::span<float> gradient);

}  // namespace nook::bake::nnao
