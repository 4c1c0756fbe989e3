#include "bakers/job/specular_training.h"

#include "sdk/src/nnao/network_file.h"

namespace nook::bake {

SpecularTraining train_specular(const nnao::SpecularFitSettings& settings,
                                const nnao::DatasetProgress& progress) {
  const nook::nnao::Network network = nook::nnao::read_network(nook::nnao::default_network_file());
  const nnao::SpecularSamples samples = trace_specular_samples(network, settings, progress);
  const nook::nnao::SpecularNumbers numbers = fit_specular(samples.training, settings);
  return {specular_header(numbers, settings), specular_error(samples.validation, numbers),
          samples.training.size(), samples.validation.size()};
}

}  // namespace nook::bake
