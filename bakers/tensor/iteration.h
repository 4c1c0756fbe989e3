// The loop of Algorithm 1, which CTA shares.
#pragma once

#include <functional>

#include "bakers/tensor/working_fit.h"

namespace nook::bake::tensor {

struct StepResult {
  double error = 0;        // || A_G - A^ ||^2
  std::size_t splits = 0;  // empty clusters that were filled
};
// One iteration: both stages, from the fit that it changes. objective is that of the iteration before.
using Step =
    std::function<StepResult(WorkingFit& fit, const TensorView& reduced, int iteration, double objective)>;

// Checks the input, reduces global modes, fits the seeds, and then steps until the error hardly falls any
// more, or a step makes it rise, which is undone and ends it.
ClusteredFit iterate(const TensorView& a, const ClusteredSettings& settings, const OnClustered& progress,
                     const Step& step);

}  // namespace nook::bake::tensor
