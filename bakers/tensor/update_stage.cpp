#include "bakers/tensor/update_stage.h"

#include <algorithm>

#include "bakers/tensor/blocks.h"
#include "bakers/tensor/progress.h"

namespace nook::bake::tensor {
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
    // R'_c: the residual of all clusters and this one's own part, of its members only.
    Tensor shrunk = sub_tensors(residual, fit.mode, cluster.members);
    add(shrunk, expand_members(cluster, fit.mode), 1);
    fit_members(cluster, shrunk, settings);
    add(shrunk, expand_members(cluster, fit.mode), -1);
    put_back(residual, fit.mode, cluster.members, shrunk);
  }
}

}  // namespace nook::bake::tensor
