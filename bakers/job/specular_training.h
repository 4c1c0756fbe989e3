// The fit of specular occlusion from samples to the header that shaders and the runtime include.
#pragma once

#include <string>

#include "bakers/nnao/specular_fit.h"

namespace nook::bake {

struct SpecularTraining {
  std::string header;
  nnao::SpecularError error;  // over the validation samples
  std::size_t training_points = 0, validation_points = 0;
};

// Traces samples with the embedded network and fits them. Return false from progress to stop, which throws
// Failure(CANCELLED). The same bits on any number of threads.
SpecularTraining train_specular(const nnao::SpecularFitSettings& settings,
                                const nnao::DatasetProgress& progress);

}  // namespace nook::bake
