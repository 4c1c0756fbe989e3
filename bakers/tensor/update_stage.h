// The update stage of Algorithm 1.
#pragma once

#include "bakers/tensor/working_fit.h"

namespace nook::bake::tensor {

// One cluster after the other is fitted to what the others leave of its members, (20) to (22). residual is
// A_G - A^ before and after.
void update_stage(WorkingFit& fit, Tensor& residual, const ClusteredSettings& settings,
                  const OnClustered& progress, int iteration, double objective);

}  // namespace nook::bake::tensor
