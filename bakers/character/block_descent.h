// Block coordinate descent as Le et al. 2019 fit their model (slides 25 to 33): L-BFGS over the non-linear
// layer with the linear one cached, then constrained least squares, in turn.
#pragma once

#include <cstddef>

#include "bakers/character/fit_state.h"

namespace nook::bake {

struct LbfgsSettings {
  int iterations = 20;
  int history = 10;
};

// One block: lowers the cached objective over the non-linear parameters. Returns the error it ends with;
// parameters never get worse than they came.
double descend_non_linear(FitState& state, const TrainingSet& set, const LbfgsSettings& settings);

}  // namespace nook::bake
