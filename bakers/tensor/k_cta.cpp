#include <cmath>
#include <utility>

#include "tensor/check.h"
#include "tensor/clustering_stage.h"
#include "tensor/update_stage.h"

namespace nook::bake::tensor {

ClusteredFit fit_k_cta(const TensorView& a, const ClusteredSettings& settings, const OnClustered& progress) {
  check_tensor(a);
  check_clustered(a.dimensions, settings);
  Reduction reduction = reduce_global_modes(a, settings, progress);
  WorkingFit fit;
  std::vector<double> objective{reduction.lost + fit_seeds(fit, reduction.view, settings, progress)};
  double norms = sum_of_core_norms(fit);
  bool undone = false;
  std::size_t splits = 0;
  Tensor residual;
  for (int iteration = 1; iteration <= settings.iterations; ++iteration) {
    const WorkingFit before = fit;
    const std::size_t filled = clustering_stage(fit, reduction.view, settings, residual);
    update_stage(fit, residual, settings, progress, iteration, objective.back());
    const double now = reduction.lost + squared_norm(residual);
    if (now > objective.back()) {
      fit = before;
      undone = true;
      break;
    }
    splits += filled;
    objective.push_back(now);
    const double norms_before = std::exchange(norms, sum_of_core_norms(fit));
    if (std::abs(norms - norms_before) <= settings.tolerance * norms_before) break;
  }
  ClusteredFit result = finish(std::move(fit), std::move(reduction), a, settings);
  result.objective = std::move(objective);
  result.undone = undone;
  result.splits = splits;
  return result;
}

}  // namespace nook::bake::tensor
