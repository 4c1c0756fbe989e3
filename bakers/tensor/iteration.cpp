#include "bakers/tensor/iteration.h"

#include <utility>

#include "bakers/tensor/check.h"

namespace nook::bake::tensor {
namespace {

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

}  // namespace

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

}  // namespace nook::bake::tensor
