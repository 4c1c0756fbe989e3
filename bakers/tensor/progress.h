// Reports the progress of a clustered fit to its caller.
#pragma once

#include "bakers/tensor/clustered_fit.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::tensor {

// Throws CANCELLED if the caller's function returns false.
inline void report(const OnClustered& progress, int iteration, const ClusteredSettings& settings,
                   std::size_t cluster, double objective) {
  if (progress && !progress({iteration, settings.iterations, cluster, objective}))
    throw Failure(NOOK_ERROR_CANCELLED,
                  "stopped by the progress callback in iteration %d of the clustered fit", iteration);
}

}  // namespace nook::bake::tensor
