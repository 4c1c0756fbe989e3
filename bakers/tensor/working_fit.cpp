#include "bakers/tensor/working_fit.h"

#include <algorithm>

#include "bakers/tensor/nsvd.h"
#include "bakers/tensor/tensor.h"

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
  // If only one mode is reduced, the basis of the HOSVD is already optimal.
  if (reduced_modes > 1)
    reduction.global_basis = alternate(a, squared, reduction.global_basis, {ranks, 0, 10, 1e-4}, stop).basis;
  reduction.held = project(a, reduction.global_basis);
  reduction.view = reduction.held;
  reduction.lost = std::max(0.0, squared - squared_norm(reduction.held));
  return reduction;
}

namespace {

using Eigen::Index;

// If a cluster has fewer members than R_m, adds zero slices to the core and zero columns to the mixing rows.
void pad_to_rank(WorkingCluster& cluster, std::size_t mode, std::size_t rank) {
  const Index members = cluster.mixing.rows(), found = cluster.mixing.cols();
  if (std::size_t(found) == rank) return;
  Matrix pad = Matrix::Zero(Index(rank), found);
  pad.topRows(found).setIdentity();
  cluster.parts.core = mode_product(cluster.parts.core, mode, pad);
  const Matrix found_rows = cluster.mixing;
  cluster.mixing = Matrix::Zero(members, Index(rank));
  cluster.mixing.leftCols(found) = found_rows;
}

}  // namespace

void list_members(WorkingFit& fit) {
  for (WorkingCluster& cluster : fit.clusters) cluster.members.clear();
  for (std::size_t e = 0; e < fit.membership.size(); ++e)
    fit.clusters[fit.membership[e]].members.push_back(e / fit.mixture);
}

double fit_members(WorkingCluster& cluster, const Tensor& shrunk, const ClusteredSettings& settings) {
  const std::size_t m = settings.mode, rank = settings.ranks[m];
  Alternation alternation;
  alternation.ranks = settings.ranks;
  for (std::size_t n = 0; n < shrunk.dimensions.size(); ++n)
    alternation.ranks[n] = std::min(settings.ranks[n], shrunk.dimensions[n]);
  alternation.first = m;
  alternation.sweeps = settings.sweeps;
  alternation.tolerance = 0;
  const bool whole = alternation.ranks[m] == shrunk.dimensions[m];
  std::vector<Matrix> bases = cluster.fitted ? cluster.parts.basis : hosvd_bases(shrunk, alternation.ranks);
  if (cluster.fitted) bases[m] = whole ? Matrix() : cluster.mixing;
  const double squared = squared_norm(shrunk);
  Nsvd fit = alternate(shrunk, squared, std::move(bases), alternation);
  cluster.mixing = whole ? Matrix(Matrix::Identity(Index(shrunk.dimensions[m]), Index(shrunk.dimensions[m])))
                         : fit.basis[m];
  fit.basis[m] = Matrix();
  cluster.parts.core = std::move(fit.core);
  cluster.parts.basis = std::move(fit.basis);
  cluster.fitted = true;
  pad_to_rank(cluster, m, rank);
  return fit.objective.back();
}

Tensor expand_members(const WorkingCluster& cluster, std::size_t mode) {
  std::vector<Matrix> bases = cluster.parts.basis;
  bases[mode] = cluster.mixing;
  return mode_products(cluster.parts.core, bases);
}

double fit_seeds(WorkingFit& fit, const TensorView& reduced, const ClusteredSettings& settings,
                 const OnClustered& progress) {
  fit.mode = settings.mode;
  fit.mixture = 1;
  fit.membership = settings.seeds;
  fit.clusters.assign(settings.clusters, {});
  list_members(fit);
  double error = 0;
  for (std::size_t c = 0; c < fit.clusters.size(); ++c) {
    report(progress, 0, settings, c, 0);
    error +=
        fit_members(fit.clusters[c], sub_tensors(reduced, settings.mode, fit.clusters[c].members), settings);
  }
  return error;
}

}  // namespace nook::bake::tensor
