#include "bakers/tensor/clustering_stage.h"
#include "bakers/tensor/iteration.h"
#include "bakers/tensor/update_stage.h"

namespace nook::bake::tensor {

ClusteredFit fit_k_cta(const TensorView& a, const ClusteredSettings& settings, const OnClustered& progress) {
  Tensor residual;
  return iterate(a, settings, progress,
                 [&](WorkingFit& fit, const TensorView& reduced, int iteration, double objective) {
                   const std::size_t splits = clustering_stage(fit, reduced, settings, residual);
                   update_stage(fit, residual, settings, progress, iteration, objective);
                   return StepResult{squared_norm(residual), splits};
                 });
}

}  // namespace nook::bake::tensor
