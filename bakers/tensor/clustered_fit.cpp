#include "bakers/tensor/clustered_fit.h"

#include "bakers/tensor/mode_product.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::tensor {

using Eigen::Index;

ClusteredFit as_one_cluster(const Nsvd& fit, std::size_t mode) {
  if (mode >= fit.basis.size())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "mode %zu of an N-SVD of order %zu", mode + 1,
                  fit.basis.size());
  ClusteredFit one;
  one.mode = mode;
  one.ranks = fit.core.dimensions;
  one.dimensions = fit.core.dimensions;
  for (std::size_t n = 0; n < fit.basis.size(); ++n)
    if (fit.basis[n].size() > 0) one.dimensions[n] = std::size_t(fit.basis[n].rows());
  one.global_basis.resize(fit.basis.size());
  one.clusters.push_back({fit.core, fit.basis});
  one.clusters[0].basis[mode] = Matrix();
  const Index sub_tensors = Index(one.dimensions[mode]);
  one.mixture.count = 1;
  one.mixture.membership.assign(one.dimensions[mode], 0);
  one.mixture.coefficients =
      fit.basis[mode].size() > 0 ? fit.basis[mode] : Matrix(Matrix::Identity(sub_tensors, sub_tensors));
  one.objective = fit.objective;
  return one;
}

Tensor reconstruct(const ClusteredFit& fit) {
  const Index rank = Index(fit.ranks[fit.mode]);
  Dimensions reduced = fit.dimensions;
  for (std::size_t n = 0; n < reduced.size(); ++n)
    if (fit.global_basis[n].size() > 0) reduced[n] = fit.ranks[n];
  Tensor sum(reduced);
  for (std::size_t c = 0; c < fit.clusters.size(); ++c) {
    Matrix mixing = Matrix::Zero(Index(fit.dimensions[fit.mode]), rank);
    for (std::size_t e = 0; e < fit.mixture.membership.size(); ++e) {
      const Index i = Index(e / fit.mixture.count), k = Index(e % fit.mixture.count);
      if (fit.mixture.membership[e] == c)
        mixing.row(i) = fit.mixture.coefficients.block(i, k * rank, 1, rank);
    }
    std::vector<Matrix> bases = fit.clusters[c].basis;
    bases[fit.mode] = mixing;
    const Tensor part = mode_products(fit.clusters[c].core, bases);
    for (std::size_t e = 0; e < sum.data.size(); ++e) sum.data[e] += part.data[e];
  }
  return mode_products(sum, fit.global_basis);
}

}  // namespace nook::bake::tensor
