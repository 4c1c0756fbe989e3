#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>

#include "bakers/tensor/clustered_fit.h"
#include "bakers/tensor/cta_stages.h"
#include "bakers/tensor/mixture_search.h"
#include "bakers/tensor/tensor.h"
#include "bakers/tensor/working_fit.h"
#include "sdk/src/core/failure.h"

namespace nook::bake::tensor {

namespace {

// The loop of Algorithm 1. CTA and K-CTA both use it.

struct StepResult {
  double error = 0;        // squared norm of A_G - A^
  std::size_t splits = 0;  // number of empty clusters that were filled
};
// Runs one iteration: both stages. `objective` is the result of the previous iteration.
using Step =
    std::function<StepResult(WorkingFit& fit, const TensorView& reduced, int iteration, double objective)>;

using Eigen::Index;

ClusteredFit as_result(WorkingFit&& fit, Reduction&& reduction, const TensorView& a,
                       const ClusteredSettings& settings) {
  ClusteredFit result;
  result.mode = fit.mode;
  result.dimensions = a.dimensions;
  result.ranks = settings.ranks;
  result.global_basis = std::move(reduction.global_basis);
  result.mixture.count = fit.mixture;
  const Index rank = Index(settings.ranks[fit.mode]);
  result.mixture.coefficients = Matrix::Zero(Index(a.dimensions[fit.mode]), Index(fit.mixture) * rank);
  std::vector<Index> next(fit.clusters.size());
  for (std::size_t e = 0; e < fit.membership.size(); ++e) {
    const std::uint32_t c = fit.membership[e];
    result.mixture.coefficients.block(Index(e / fit.mixture), Index(e % fit.mixture) * rank, 1, rank) =
        fit.clusters[c].mixing.row(next[c]++);
  }
  result.mixture.membership = std::move(fit.membership);
  for (WorkingCluster& cluster : fit.clusters) result.clusters.push_back(std::move(cluster.parts));
  return result;
}

// Checks the input, reduces global modes and fits the initial clusters. Then repeats `step` until the error
// hardly falls any more. If a step raises the error, undoes the step and ends the fit.
ClusteredFit iterate(const TensorView& a, const ClusteredSettings& settings, const OnClustered& progress,
                     const Step& step) {
  check_tensor(a);
  check_clustered(a.dimensions, settings);
  Reduction reduction = reduce_global_modes(a, settings, progress);
  WorkingFit fit;
  std::vector<double> objective{reduction.lost + fit_seeds(fit, reduction.view, settings, progress)};
  bool undone = false;
  std::size_t splits = 0;
  for (int iteration = 1; iteration <= settings.iterations; ++iteration) {
    WorkingFit before = fit;
    const StepResult stepped = step(fit, reduction.view, iteration, objective.back());
    const double now = reduction.lost + stepped.error;
    const double before_error = objective.back();
    if (now > before_error) {
      fit = std::move(before);
      undone = true;
      break;
    }
    splits += stepped.splits;
    objective.push_back(now);
    if (before_error - now <= settings.tolerance * before_error) break;
  }
  ClusteredFit result = as_result(std::move(fit), std::move(reduction), a, settings);
  result.objective = std::move(objective);
  result.undone = undone;
  result.splits = splits;
  return result;
}

// Returns the squared norm of each sub-tensor after its projection onto the cluster: the objective of (6).
Eigen::VectorXd projected_norms(const TensorView& reduced, const WorkingCluster& cluster, std::size_t mode) {
  const Tensor projected = project(reduced, cluster.parts.basis);
  const Matrix v = unfold(dual_basis(cluster.parts.core, mode).v, mode);
  return (unfold(projected, mode) * v.transpose()).rowwise().squaredNorm().cast<double>();
}

// For each cluster, returns the sub-tensors that could belong to it next: its members, and the sub-tensors
// that have the cluster's mean among their nearest means.
std::vector<std::vector<std::size_t>> tries(const WorkingFit& fit, const TensorView& reduced,
                                            std::size_t nearest) {
  const auto count = Eigen::Index(fit.membership.size()), clusters = Eigen::Index(fit.clusters.size());
  const Eigen::Map<const Matrix> rows(reduced.data, count, Eigen::Index(reduced.size()) / count);
  Matrix means = Matrix::Zero(clusters, rows.cols());
  for (Eigen::Index c = 0; c < clusters; ++c) {
    const std::vector<std::size_t>& members = fit.clusters[std::size_t(c)].members;
    for (const std::size_t i : members) means.row(c) += rows.row(Eigen::Index(i));
    if (!members.empty()) means.row(c) /= float(members.size());
  }
  const Eigen::VectorXf squares = means.rowwise().squaredNorm();
  std::vector<std::vector<std::size_t>> lists(fit.clusters.size());
  constexpr Eigen::Index block = 1024;
  std::vector<std::uint32_t> order(fit.clusters.size());
  for (Eigen::Index first = 0; first < count; first += block) {
    const Eigen::Index size = std::min(block, count - first);
    const Matrix products = rows.middleRows(first, size) * means.transpose();
    for (Eigen::Index i = 0; i < size; ++i) {
      const auto distance = [&](std::uint32_t c) { return squares[c] - 2 * products(i, c); };
      std::iota(order.begin(), order.end(), 0u);
      std::nth_element(order.begin(), order.begin() + std::ptrdiff_t(nearest - 1), order.end(),
                       [&](std::uint32_t a, std::uint32_t b) {
                         const float x = distance(a), y = distance(b);
                         return x < y || (x == y && a < b);
                       });
      const auto sub_tensor = std::size_t(first + i);
      const std::uint32_t own = fit.membership[sub_tensor];
      bool has_own = false;
      for (std::size_t k = 0; k < nearest; ++k) {
        lists[order[k]].push_back(sub_tensor);
        has_own = has_own || order[k] == own;
      }
      if (!has_own) lists[own].push_back(sub_tensor);
    }
  }
  return lists;
}

// Moves each sub-tensor to the cluster that keeps most of its norm, and fills empty clusters. Returns the
// number of filled clusters.
std::size_t classify(WorkingFit& fit, const TensorView& reduced, std::size_t nearest) {
  const std::size_t sub_tensors_count = fit.membership.size();
  std::vector<double> kept(sub_tensors_count, -1), error(sub_tensors_count);
  const bool some = nearest > 0 && nearest < fit.clusters.size();
  std::vector<std::vector<std::size_t>> lists;
  if (some) lists = tries(fit, reduced, nearest);
  for (std::size_t c = 0; c < fit.clusters.size(); ++c) {
    if (some && lists[c].empty()) continue;
    const Tensor listed = some ? sub_tensors(reduced, fit.mode, lists[c]) : Tensor();
    const Eigen::VectorXd norms =
        projected_norms(some ? TensorView(listed) : reduced, fit.clusters[c], fit.mode);
    for (Eigen::Index k = 0; k < norms.size(); ++k) {
      const std::size_t i = some ? lists[c][std::size_t(k)] : std::size_t(k);
      if (norms[k] <= kept[i]) continue;
      kept[i] = norms[k];
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
  for (WorkingCluster& cluster : fit.clusters)
    cluster.mixing = Matrix();  // the rows belong to the previous members
  return filled;
}

// Fits each cluster by an N-SVD that starts from the cluster's present bases. The first step of the sweep
// computes the mixing rows, also for new members. Returns the squared error.
double update(WorkingFit& fit, const TensorView& reduced, const ClusteredSettings& settings,
              const OnClustered& progress, int iteration, double objective) {
  double error = 0;
  for (std::size_t c = 0; c < fit.clusters.size(); ++c) {
    WorkingCluster& cluster = fit.clusters[c];
    report(progress, iteration, settings, c, objective);
    if (cluster.members.empty()) {  // an empty cluster does not reduce the error
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
    throw Failure(NOOK_ERROR_INVALID_ARGUMENT, "CTA does not mix clusters (got K = %zu, need 1); use K-CTA",
                  settings.mixture);
  return iterate(a, settings, progress,
                 [&](WorkingFit& fit, const TensorView& reduced, int iteration, double objective) {
                   const std::size_t splits = classify(fit, reduced, settings.nearest);
                   return StepResult{update(fit, reduced, settings, progress, iteration, objective), splits};
                 });
}

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
