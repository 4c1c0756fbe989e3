#include "bakers/tensor/cta_stages.h"

#include <Eigen/SVD>
#include <algorithm>

#include "bakers/tensor/blocks.h"
#include "bakers/tensor/gram.h"
#include "bakers/tensor/mixture_search.h"
#include "bakers/tensor/tensor.h"

namespace nook::bake::tensor {
namespace {

// Returns, for each cluster, its entries in `membership`.
std::vector<std::vector<std::size_t>> entries_of(const std::vector<std::uint32_t>& membership,
                                                 std::size_t clusters) {
  std::vector<std::vector<std::size_t>> entries(clusters);
  for (std::size_t e = 0; e < membership.size(); ++e) entries[membership[e]].push_back(e);
  return entries;
}

}  // namespace

std::vector<std::size_t> split_into_empty(std::vector<std::uint32_t>& membership, std::size_t mixture,
                                          std::size_t clusters, const std::vector<double>& error) {
  std::vector<std::vector<std::size_t>> entries = entries_of(membership, clusters);
  std::vector<std::size_t> changed;
  const auto error_of = [&](std::size_t entry) { return error[entry / mixture]; };
  for (std::size_t empty = 0; empty < clusters; ++empty) {
    if (!entries[empty].empty()) continue;
    std::size_t worst = clusters;
    double greatest = -1;
    for (std::size_t c = 0; c < clusters; ++c) {
      double sum = 0;
      for (std::size_t e : entries[c]) sum += error_of(e);
      if (entries[c].size() < 2 || sum <= greatest) continue;
      greatest = sum;
      worst = c;
    }
    if (worst == clusters) break;
    std::vector<std::size_t>& from = entries[worst];
    std::stable_sort(from.begin(), from.end(),
                     [&](std::size_t a, std::size_t b) { return error_of(a) < error_of(b); });
    const auto half = from.begin() + std::ptrdiff_t((from.size() + 1) / 2);
    entries[empty].assign(half, from.end());
    from.erase(half, from.end());
    for (std::size_t e : entries[empty]) membership[e] = std::uint32_t(empty);
    changed.insert(changed.end(), entries[empty].begin(), entries[empty].end());
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  return changed;
}

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<double> sub_tensor_norms(const TensorView& a, std::size_t mode) {
  const ModeLayout layout = layout_of(a.dimensions, mode);
  std::vector<double> norms(layout.size);
  tbb::parallel_for(std::size_t(0), layout.size, [&](std::size_t i) {
    for (std::size_t o = 0; o < layout.outer; ++o) {
      const float* run = a.data + (o * layout.size + i) * layout.inner;
      for (std::size_t r = 0; r < layout.inner; ++r) norms[i] += double(run[r]) * double(run[r]);
    }
  });
  return norms;
}

// Returns the clusters of each sub-tensor. A sub-tensor keeps its old clusters if they explain more than the
// clusters that the search finds. If the number of clusters K has changed, it never keeps them.
std::vector<SubTensorMix> search_all(const AtomGram& atoms, const MatrixXd& products,
                                     const WorkingFit& before, const ClusteredSettings& settings) {
  std::vector<SubTensorMix> mixes(std::size_t(products.rows()));
  tbb::parallel_for(std::size_t(0), mixes.size(), [&](std::size_t i) {
    const VectorXd own = products.row(Index(i));
    mixes[i] = search(settings.pursuit, atoms, own, settings.mixture);
    if (!settings.keep_better_clusters || before.mixture != settings.mixture) return;
    const auto first = before.membership.begin() + std::ptrdiff_t(i * before.mixture);
    SubTensorMix old = project_on(atoms, own, {first, first + std::ptrdiff_t(before.mixture)});
    if (old.explained > mixes[i].explained) mixes[i] = std::move(old);
  });
  return mixes;
}

// For sub-tensors that moved to an empty cluster, projects them again onto their other clusters. The empty
// cluster has no atoms yet, so its weight is 0 until the update stage.
void reweigh(std::vector<SubTensorMix>& mixes, const std::vector<std::size_t>& changed, const WorkingFit& fit,
             const AtomGram& atoms, const MatrixXd& products) {
  const Index rank = Index(atoms.rank);
  for (std::size_t n = 0; n < changed.size();) {
    const std::size_t i = changed[n] / fit.mixture;
    std::vector<char> emptied(fit.mixture, 0);
    for (; n < changed.size() && changed[n] / fit.mixture == i; ++n) emptied[changed[n] % fit.mixture] = 1;
    std::vector<std::uint32_t> kept;
    for (std::size_t k = 0; k < fit.mixture; ++k)
      if (!emptied[k]) kept.push_back(fit.membership[i * fit.mixture + k]);
    const VectorXd own = products.row(Index(i));
    VectorXd weights = VectorXd::Zero(Index(fit.mixture) * rank);
    if (!kept.empty()) {
      const SubTensorMix left = project_on(atoms, own, kept);
      for (Index k = 0, from = 0; k < Index(fit.mixture); ++k)
        if (!emptied[std::size_t(k)])
          weights.segment(k * rank, rank) = left.weights.segment(from++ * rank, rank);
    }
    const auto first = fit.membership.begin() + std::ptrdiff_t(i * fit.mixture);
    mixes[i].clusters.assign(first, first + std::ptrdiff_t(fit.mixture));
    mixes[i].weights = std::move(weights);
  }
}

// Post-processing (section 4.2.3), with U_{m,c} in coordinates of V_{m,c}: U = P S Q^T. P has orthonormal
// columns and becomes the mixing rows. S Q^T V becomes the core.
void orthonormalise(WorkingCluster& cluster, const MatrixXd& weights, const Tensor& v, std::size_t mode) {
  if (weights.rows() == 0) {  // the cluster stays empty
    cluster.mixing = Matrix(0, weights.cols());
    cluster.parts.core = Tensor(v.dimensions);
    return;
  }
  const Eigen::JacobiSVD<MatrixXd> svd(weights, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Index rank = weights.cols(), found = svd.singularValues().size();
  MatrixXd mixing = MatrixXd::Zero(weights.rows(), rank), w = MatrixXd::Zero(rank, rank);
  mixing.leftCols(found) = svd.matrixU();
  w.topRows(found) = svd.singularValues().asDiagonal() * svd.matrixV().transpose();
  cluster.mixing = mixing.cast<float>();
  cluster.parts.core = mode_product(v, mode, w.cast<float>());
}

// Marks filled clusters as not fitted, so that they are fitted from the start. Returns their number.
std::size_t mark_filled(WorkingFit& fit, const std::vector<std::size_t>& changed) {
  std::size_t splits = 0;
  for (std::size_t e : changed) {
    WorkingCluster& cluster = fit.clusters[fit.membership[e]];
    splits += std::size_t(cluster.fitted);
    cluster.fitted = false;
  }
  return splits;
}

// Returns the weights of a cluster's members: members x R_m.
MatrixXd rows_of(const WorkingCluster& cluster, std::uint32_t c, const std::vector<SubTensorMix>& mixes,
                 Index rank) {
  MatrixXd rows(Index(cluster.members.size()), rank);
  for (std::size_t r = 0; r < cluster.members.size(); ++r) {
    const SubTensorMix& mix = mixes[cluster.members[r]];
    const auto k = std::find(mix.clusters.begin(), mix.clusters.end(), c) - mix.clusters.begin();
    rows.row(Index(r)) = mix.weights.segment(Index(k) * rank, rank).transpose();
  }
  return rows;
}

// Returns the weights of all sub-tensors: I_m x (C R_m).
Matrix all_rows(const std::vector<SubTensorMix>& mixes, std::size_t clusters, Index rank) {
  Matrix weights = Matrix::Zero(Index(mixes.size()), Index(clusters) * rank);
  for (std::size_t i = 0; i < mixes.size(); ++i)
    for (std::size_t k = 0; k < mixes[i].clusters.size(); ++k)
      weights.block(Index(i), Index(mixes[i].clusters[k]) * rank, 1, rank) =
          mixes[i].weights.segment(Index(k) * rank, rank).transpose().cast<float>();
  return weights;
}

// Sets `residual` to A - weights x atoms. `weights` is I_m x (C R_m).
void subtract(const TensorView& a, const Matrix& weights, const Tensor& atoms, std::size_t mode,
              Tensor& residual) {
  const Tensor mixed = mode_product(atoms, mode, weights);
  residual.dimensions = a.dimensions;
  residual.data.resize(mixed.data.size());
  for_each_block(residual.data.size(), std::size_t(1) << 18, [&](std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) residual.data[e] = a.data[e] - mixed.data[e];
  });
}

}  // namespace

std::size_t clustering_stage(WorkingFit& fit, const TensorView& reduced, const ClusteredSettings& settings,
                             Tensor& residual) {
  const std::size_t m = settings.mode;
  const Index rank = Index(settings.ranks[m]);
  std::vector<ClusteredFit::Cluster> parts;
  std::vector<DualBasis> dual;
  for (const WorkingCluster& cluster : fit.clusters) {
    parts.push_back(cluster.parts);
    dual.push_back(dual_basis(cluster.parts.core, m));
  }
  const Tensor joined = join_atoms(parts, dual, reduced.dimensions, m);
  const AtomGram atoms = atom_gram(joined, m, fit.clusters.size());
  const MatrixXd products = cross_gram(reduced, joined, m);

  std::vector<SubTensorMix> mixes = search_all(atoms, products, fit, settings);
  std::vector<double> error = sub_tensor_norms(reduced, m);
  fit.mixture = settings.mixture;
  fit.membership.clear();
  for (std::size_t i = 0; i < mixes.size(); ++i) {
    error[i] -= mixes[i].explained;
    fit.membership.insert(fit.membership.end(), mixes[i].clusters.begin(), mixes[i].clusters.end());
  }
  const std::vector<std::size_t> changed =
      split_into_empty(fit.membership, fit.mixture, fit.clusters.size(), error);
  reweigh(mixes, changed, fit, atoms, products);
  list_members(fit);
  const std::size_t splits = mark_filled(fit, changed);
  for (std::size_t c = 0; c < fit.clusters.size(); ++c)
    orthonormalise(fit.clusters[c], rows_of(fit.clusters[c], std::uint32_t(c), mixes, rank), dual[c].v, m);
  subtract(reduced, all_rows(mixes, fit.clusters.size(), rank), joined, m, residual);
  return splits;
}

namespace {

void add(Tensor& to, const Tensor& from, float sign) {
  for_each_block(to.data.size(), std::size_t(1) << 18, [&](std::size_t first, std::size_t last) {
    for (std::size_t e = first; e < last; ++e) to.data[e] += sign * from.data[e];
  });
}

void put_back(Tensor& residual, std::size_t mode, const std::vector<std::size_t>& members,
              const Tensor& shrunk) {
  const ModeLayout layout = layout_of(residual.dimensions, mode);
  const float* from = shrunk.data.data();
  for (std::size_t o = 0; o < layout.outer; ++o)
    for (std::size_t i : members) {
      std::copy_n(from, layout.inner, &residual.data[(o * layout.size + i) * layout.inner]);
      from += layout.inner;
    }
}

}  // namespace

void update_stage(WorkingFit& fit, Tensor& residual, const ClusteredSettings& settings,
                  const OnClustered& progress, int iteration, double objective) {
  for (std::size_t c = 0; c < fit.clusters.size(); ++c) {
    WorkingCluster& cluster = fit.clusters[c];
    report(progress, iteration, settings, c, objective);
    if (cluster.members.empty()) continue;
    // R'_c: the residual of all clusters plus this cluster's own part, only for the cluster's members.
    Tensor shrunk = sub_tensors(residual, fit.mode, cluster.members);
    add(shrunk, expand_members(cluster, fit.mode), 1);
    fit_members(cluster, shrunk, settings);
    add(shrunk, expand_members(cluster, fit.mode), -1);
    put_back(residual, fit.mode, cluster.members, shrunk);
  }
}

}  // namespace nook::bake::tensor
