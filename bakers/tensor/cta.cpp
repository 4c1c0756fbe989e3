#include <cmath>
#include <utility>

#include "core/failure.h"
#include "tensor/atoms.h"
#include "tensor/blocks.h"
#include "tensor/check.h"
#include "tensor/empty_clusters.h"
#include "tensor/mode_product.h"
#include "tensor/working_fit.h"

namespace nook::bake::tensor {
namespace {

// The projected square norm of each sub-tensor in cluster c, the objective of (6).
Eigen::VectorXd projected_norms(const TensorView& reduced, const WorkingCluster& cluster, std::size_t mode) {
  const Tensor projected = project(reduced, cluster.parts.basis);
  const Matrix v = unfold(dual_basis(cluster.parts.core, mode).v, mode);
  return (unfold(projected, mode) * v.transpose()).rowwise().squaredNorm().cast<double>();
}

// Each sub-tensor goes to the cluster that keeps most of its norm; empty clusters are filled. Returns their
// number.
std::size_t classify(WorkingFit& fit, const TensorView& reduced) {
  const std::size_t sub_tensors_count = fit.membership.size();
  std::vector<double> kept(sub_tensors_count, -1), error(sub_tensors_count);
  for (std::size_t c = 0; c < fit.clusters.size(); ++c) {
    const Eigen::VectorXd norms = projected_norms(reduced, fit.clusters[c], fit.mode);
    for (std::size_t i = 0; i < sub_tensors_count; ++i) {
      if (norms[Eigen::Index(i)] <= kept[i]) continue;
      kept[i] = norms[Eigen::Index(i)];
      fit.membership[i] = std::uint32_t(c);
    }
  }
  for (std::size_t i = 0; i < sub_tensors_count; ++i)
    error[i] = squared_norm(sub_tensors(reduced, fit.mode, {i})) - kept[i];
  std::size_t filled = 0;
  for (std::size_t i : split_into_empty(fit.membership, 1, fit.clusters.size(), error)) {
    WorkingCluster& cluster = fit.clusters[fit.membership[i]];
    filled += std::size_t(cluster.fitted);
    cluster.fitted = false;
  }
  list_members(fit);
  for (WorkingCluster& cluster : fit.clusters) cluster.mixing = Matrix();  // of the members before
  return filled;
}

}  // namespace

ClusteredFit fit_cta(const TensorView& a, const ClusteredSettings& settings, const OnClustered& progress) {
  check_tensor(a);
  check_clustered(a.dimensions, settings);
  if (settings.mixture != 1)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "CTA mixes no clusters (got K = %zu, need 1); use K-CTA",
                  settings.mixture);
  Reduction reduction = reduce_global_modes(a, settings, progress);
  WorkingFit fit;
  std::vector<double> objective{reduction.lost + fit_seeds(fit, reduction.view, settings, progress)};
  double norms = sum_of_core_norms(fit);
  bool undone = false;
  std::size_t splits = 0;
  for (int iteration = 1; iteration <= settings.iterations; ++iteration) {
    const WorkingFit before = fit;
    const std::size_t filled = classify(fit, reduction.view);
    double now = reduction.lost;
    for (std::size_t c = 0; c < fit.clusters.size(); ++c) {
      WorkingCluster& cluster = fit.clusters[c];
      report(progress, iteration, settings, c, objective.back());
      if (cluster.members.empty()) {
        cluster.parts.core = Tensor(cluster.parts.core.dimensions);
        continue;
      }
      const Tensor shrunk = sub_tensors(reduction.view, fit.mode, cluster.members);
      // The mixing rows of the new members come out of the sweep, which begins with them.
      now += fit_members(cluster, shrunk, settings);
    }
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
