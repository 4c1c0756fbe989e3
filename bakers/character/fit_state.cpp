#include "bakers/character/fit_state.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace nook::bake {

std::vector<float> shadows_of(const FitState& state, std::span<const Pose> poses) {
  const std::size_t padded = state.structure.padded_count();
  std::vector<float> shadows(poses.size() * padded);
  const NonLinearLayer layer(state.structure);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, poses.size(), 16), [&](const auto& range) {
    LayerWorkspace workspace(state.structure);
    for (std::size_t t = range.begin(); t < range.end(); ++t)
      layer.forward(poses[t], state.parameters, workspace, &shadows[t * padded]);
  });
  return shadows;
}

FitError measure_fit(const FitState& state, const TrainingSet& set, std::size_t first, std::size_t last,
                     std::span<const float> vertex_area) {
  const std::size_t padded = state.structure.padded_count(), entries = state.linear.entries;
  const std::vector<float> shadows = shadows_of(state, std::span(set.poses).subspan(first, last - first));
  // Each pose has a partial sum. The partial sums are added in a fixed order, so that the number of threads
  // does not change the bits.
  std::vector<FitError> partial(last - first);
  tbb::parallel_for(std::size_t(0), last - first, [&](std::size_t t) {
    const float* shadow = &shadows[t * padded];
    const auto target = set.targets.row(first + t);
    for (std::size_t i = 0; i < target.size(); ++i) {
      float dark = state.linear.bias[i];
      for (std::size_t s = i * entries; s < (i + 1) * entries; ++s)
        dark += state.linear.alpha[s] * shadow[state.linear.key_point[s]];
      const double e = double(std::clamp(1 - dark, 0.0f, 1.0f)) - double(target[i]) * AoTargets::scale;
      partial[t].mse += e * e;
      partial[t].mse_area += e * e * double(vertex_area[i]);
    }
  });
  double area = 0;
  for (float a : vertex_area) area += a;
  FitError total;
  for (const FitError& p : partial) {
    total.mse += p.mse;
    total.mse_area += p.mse_area;
  }
  total.mse /= double(partial.size()) * double(vertex_area.size());
  total.mse_area /= double(partial.size()) * area;
  return total;
}

}  // namespace nook::bake
