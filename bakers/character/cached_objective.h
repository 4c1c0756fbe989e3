// The squared error as a quadratic form of the shadows, with the linear layer folded into matrices (Le et al.
// 2019, slides 55 to 57): what block coordinate descent minimises over the non-linear layer.
#pragma once

#include <Eigen/Dense>
#include <span>

#include "bakers/character/fit_state.h"

namespace nook::bake {

// E = sum over poses of  shadow^T A shadow - 2 B_t^T shadow + constant, divided by poses * vertices, with
// A = sum_i w_i alpha_i alpha_i^T and B_t = sum_i w_i alpha_i (1 - beta_i - target_ti). The paper prints + 2
// for the linear term; from its own definition of B it is - 2.
struct CachedObjective {
  using RowMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::MatrixXf a;  // padded key points squared
  RowMatrix b;        // fitted poses x padded key points
  double constant = 0;
};

CachedObjective cache_linear_layer(const FitState& state, const TrainingSet& set);

// Error over the fitted poses, unclamped and weighted by set.vertex_weight, and its gradient by the
// non-linear parameters (resized and overwritten; may be null). It costs poses x key points^2, where a sum
// over vertices would cost poses x vertices x entries with a scattered gather.
double evaluate_cached(const FitState& state, const TrainingSet& set, const CachedObjective& cache,
                       std::vector<double>* gradient);

}  // namespace nook::bake
