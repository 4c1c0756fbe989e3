#include "bakers/tensor/global_modes.h"

#include <algorithm>

#include "bakers/tensor/alternation.h"
#include "bakers/tensor/mode_product.h"
#include "bakers/tensor/progress.h"

namespace nook::bake::tensor {

Reduction reduce_global_modes(const TensorView& a, const ClusteredSettings& settings,
                              const OnClustered& progress) {
  Reduction reduction;
  std::vector<std::size_t> ranks = a.dimensions;
  std::size_t reduced_modes = 0;
  for (std::size_t n : settings.global_modes) {
    reduced_modes += settings.ranks[n] < a.dimensions[n] && ranks[n] == a.dimensions[n];
    ranks[n] = settings.ranks[n];
  }
  reduction.view = a;
  reduction.global_basis.resize(a.order());
  if (reduced_modes == 0) return reduction;
  const double squared = squared_norm(a);
  const OnNsvd stop = [&](const NsvdProgress&) {
    report(progress, 0, settings, 0, 0);
    return true;
  };
  reduction.global_basis = hosvd_bases(a, ranks, stop);
  // With the others whole, the best basis of a single mode is the HOSVD's.
  if (reduced_modes > 1)
    reduction.global_basis = alternate(a, squared, reduction.global_basis, {ranks, 0, 10, 1e-4}, stop).basis;
  reduction.held = project(a, reduction.global_basis);
  reduction.view = reduction.held;
  reduction.lost = std::max(0.0, squared - squared_norm(reduction.held));
  return reduction;
}

}  // namespace nook::bake::tensor
