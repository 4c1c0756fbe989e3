#include "bakers/tensor/atoms.h"
#include "bakers/tensor/empty_clusters.h"
#include "bakers/tensor/iteration.h"
#include "bakers/tensor/mode_product.h"
#include "bakers/tensor/progress.h"
#include "sdk/src/core/failure.h"

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

// Each cluster's N-SVD from its bases; the sweep, which begins with them, gives the mixing rows of new
// members. Returns the squared error.
double update(WorkingFit& fit, const TensorView& reduced, const ClusteredSettings& settings,
              const OnClustered& progress, int iteration, double objective) {
  double error = 0;
  for (std::size_t c = 0; c < fit.clusters.size(); ++c) {
    WorkingCluster& cluster = fit.clusters[c];
    report(progress, iteration, settings, c, objective);
    if (cluster.members.empty()) {  // explains nothing
      cluster.parts.core = Tensor(cluster.parts.core.dimensions);
      continue;
    }
    error += fit_members(cluster, sub_tensors(reduced, fit.mode, cluster.members), settings);
  }
  return error;
}

}  // namespace

ClusteredFit fit_cta(const TensorView& a, const ClusteredSettings& settings, const OnClustered& progress) {
  if (settings.mixture != 1)
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "CTA mixes no clusters (got K = %zu, need 1); use K-CTA",
                  settings.mixture);
  return iterate(a, settings, progress,
                 [&](WorkingFit& fit, const TensorView& reduced, int iteration, double objective) {
                   const std::size_t splits = classify(fit, reduced);
                   return StepResult{update(fit, reduced, settings, progress, iteration, objective), splits};
                 });
}

}  // namespace nook::bake::tensor
