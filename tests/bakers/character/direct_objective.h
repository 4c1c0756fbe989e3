// The error of a fit summed over poses and vertices as it is defined: the reference of the cached quadratic
// form.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

#include "bakers/character/fit_state.h"

namespace nook::bake::test {

// Returns the weighted squared error of one pose, and its derivative by each key point's shadow in `slope`.
inline double pose_error(const FitState& state, const TrainingSet& set, std::size_t pose,
                         const std::vector<float>& shadow, std::vector<float>& slope) {
  const LinearLayerFit& linear = state.linear;
  const auto target = set.targets.row(pose);
  std::fill(slope.begin(), slope.end(), 0.0f);
  double error = 0;
  for (std::size_t i = 0; i < linear.vertex_count(); ++i) {
    float ao = 1 - linear.bias[i];
    for (std::size_t s = i * linear.entries; s < (i + 1) * linear.entries; ++s)
      ao -= linear.alpha[s] * shadow[linear.key_point[s]];
    const float e = ao - float(target[i]) * AoTargets::scale;
    error += double(set.vertex_weight[i]) * double(e) * double(e);
    for (std::size_t s = i * linear.entries; s < (i + 1) * linear.entries; ++s)
      slope[linear.key_point[s]] -= 2 * set.vertex_weight[i] * e * linear.alpha[s];
  }
  return error;
}

// Has the arguments and the result of evaluate_cached.
inline double evaluate_direct(const FitState& state, const TrainingSet& set, std::vector<double>* gradient) {
  const std::size_t poses = set.fitted(), padded = state.structure.padded_count();
  const NonLinearLayer layer(state.structure);
  std::vector<double> error(poses);
  std::vector<std::vector<float>> partial(poses);
  tbb::parallel_for(std::size_t(0), poses, [&](std::size_t t) {
    LayerWorkspace workspace(state.structure);
    std::vector<float> shadow(padded), slope(padded);
    layer.forward(set.poses[t], state.parameters, workspace, shadow.data());
    error[t] = pose_error(state, set, t, shadow, slope);
    if (!gradient) return;
    partial[t].assign(state.parameters.size(), 0.0f);
    layer.backward(set.poses[t], state.parameters, workspace, slope.data(), 1, partial[t]);
  });
  double total = 0;
  for (double e : error) total += e;
  const double scale = 1 / (double(poses) * double(state.linear.vertex_count()));
  if (gradient) {
    gradient->assign(state.parameters.size(), 0.0);
    for (const std::vector<float>& p : partial)
      for (std::size_t i = 0; i < p.size(); ++i) (*gradient)[i] += double(p[i]) * scale;
  }
  return total * scale;
}

}  // namespace nook::bake::test
