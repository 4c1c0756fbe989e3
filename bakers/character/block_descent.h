// Block coordinate descent as Le et al. 2019 fit their model (slides 25 to 33): L-BFGS over the non-linear
// layer with the linear one cached, then constrained least squares, in turn.
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <span>

#include "bakers/character/fit_state.h"

namespace nook::bake {

// The cached objective is the squared error as a quadratic form of the shadows, with the linear layer folded
// into matrices (Le et al. 2019, slides 55 to 57). Block coordinate descent minimises it over the non-linear
// layer.

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

// Returns the error over the fitted poses, unclamped and weighted by set.vertex_weight. Overwrites and
// resizes its gradient with respect to the non-linear parameters, which may be null. The cost is poses x key
// points^2. A sum over vertices would cost poses x vertices x entries, with a scattered gather.
double evaluate_cached(const FitState& state, const TrainingSet& set, const CachedObjective& cache,
                       std::vector<double>* gradient);

struct LbfgsSettings {
  int iterations = 20;
  int history = 10;
};

// Runs one block: lowers the cached objective over the non-linear parameters. Returns the final error, which
// is never above the first.
double descend_non_linear(FitState& state, const TrainingSet& set, const LbfgsSettings& settings);

}  // namespace nook::bake
