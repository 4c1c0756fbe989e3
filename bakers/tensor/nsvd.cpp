#include "bakers/tensor/nsvd.h"

#include "bakers/tensor/alternation.h"
#include "bakers/tensor/check.h"
#include "bakers/tensor/mode_product.h"

namespace nook::bake::tensor {

Nsvd fit_nsvd(const TensorView& a, const NsvdSettings& settings, const OnNsvd& progress) {
  check_tensor(a);
  check_ranks(a.dimensions, settings.ranks);
  check_iterations(settings.iterations, settings.tolerance);
  OnNsvd of_hosvd;
  if (progress)
    of_hosvd = [&](const NsvdProgress& now) { return progress({0, settings.iterations, now.mode, 0}); };
  std::vector<Matrix> bases = hosvd_bases(a, settings.ranks, of_hosvd);
  return alternate(a, squared_norm(a), std::move(bases),
                   {settings.ranks, 0, settings.iterations, settings.tolerance}, progress);
}

Tensor reconstruct(const Nsvd& fit) {
  return mode_products(fit.core, fit.basis);
}

}  // namespace nook::bake::tensor
