#include "bakers/tensor/clustered_fit.h"

#include <algorithm>
#include <cmath>

#include "bakers/tensor/tensor.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::tensor {

using Eigen::Index;

ClusteredFit as_one_cluster(const Nsvd& fit, std::size_t mode) {
  if (mode >= fit.basis.size())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "mode %zu does not exist in an N-SVD of order %zu", mode + 1,
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

namespace {

void check_seeds(std::size_t sub_tensors, const ClusteredSettings& s) {
  if (s.seeds.size() != sub_tensors)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "there are seeds for %zu sub-tensors, but mode %zu has %zu",
                  s.seeds.size(), s.mode + 1, sub_tensors);
  std::vector<std::size_t> members(s.clusters);
  for (std::size_t i = 0; i < sub_tensors; ++i) {
    if (s.seeds[i] >= s.clusters)
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "sub-tensor %zu starts in cluster %u (need less than %zu)",
                    i, s.seeds[i], s.clusters);
    ++members[s.seeds[i]];
  }
  const auto empty = std::find(members.begin(), members.end(), std::size_t(0));
  if (empty != members.end())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "no sub-tensor starts in cluster %zu; each cluster needs at least one",
                  std::size_t(empty - members.begin()));
}

}  // namespace

void check_ranks(const Dimensions& dimensions, const std::vector<std::size_t>& ranks) {
  if (ranks.size() != dimensions.size())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "got %zu ranks for a tensor of order %zu; need one for each mode", ranks.size(),
                  dimensions.size());
  for (std::size_t n = 0; n < ranks.size(); ++n)
    if (ranks[n] < 1 || ranks[n] > dimensions[n])
      throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                    "the rank of mode %zu is out of range (got %zu, need 1 to %zu)", n + 1, ranks[n],
                    dimensions[n]);
}

void check_iterations(int iterations, double tolerance) {
  if (iterations < 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "iterations are negative (got %d, need 0 or more)",
                  iterations);
  if (!(tolerance >= 0) || !std::isfinite(tolerance))
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "tolerance is out of range (got %g, need 0 or more)",
                  tolerance);
}

void check_clustered(const Dimensions& dimensions, const ClusteredSettings& s) {
  if (s.mode >= dimensions.size())
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "mode %zu cannot be clustered, because the tensor has only %zu modes", s.mode + 1,
                  dimensions.size());
  check_ranks(dimensions, s.ranks);
  check_iterations(s.iterations, s.tolerance);
  const std::size_t sub_tensors = dimensions[s.mode];
  if (s.clusters < 1 || s.clusters > sub_tensors)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the number of clusters is out of range (got %zu, need 1 to "
                  "%zu, the number of sub-tensors of mode %zu)",
                  s.clusters, sub_tensors, s.mode + 1);
  if (s.mixture < 1 || s.mixture > s.clusters)
    throw Failure(
        NOOK_ERROR_INVALID_ARGUMENT,
        "the number of mixed clusters is out of range (got %zu, need 1 to %zu, the number of clusters)",
        s.mixture, s.clusters);
  if (s.nearest > 0 && s.mode != 0)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT,
                  "the nearest clusters can be tried in mode 1 only (mode %zu is clustered)", s.mode + 1);
  if (s.sweeps < 1)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "sweeps are out of range (got %d, need 1 or more)", s.sweeps);
  for (std::size_t n : s.global_modes)
    if (n >= dimensions.size() || n == s.mode)
      throw Failure(
          NOOK_ERROR_INVALID_ARGUMENT,
          "mode %zu cannot have a global basis (the tensor has %zu modes, and mode %zu is clustered)", n + 1,
          dimensions.size(), s.mode + 1);
  check_seeds(sub_tensors, s);
}

}  // namespace nook::bake::tensor
