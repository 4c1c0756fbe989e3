// Block coordinate descent, the fit of Le et al. 2019 (slides 25 to 33). It alternates between two steps. The
// first step runs L-BFGS over the non-linear layer, with the linear layer cached. The second step solves a
// constrained least-squares problem for the linear layer.
#pragma once

#include <Eigen/Dense>
#include <cstddef>
#include <span>

#include "bakers/character/fit_state.h"

namespace nook::bake {

// The cached objective is the squared error, written as a quadratic form of the shadows. The matrices of the
// form contain the linear layer (Le et al. 2019, slides 55 to 57). Block coordinate descent minimises the
// objective over the non-linear layer.

// E = sum over poses of shadow^T A shadow - 2 B_t^T shadow + constant, divided by poses * vertices, with A =
// sum_i w_i alpha_i alpha_i^T and B_t = sum_i w_i alpha_i (1 - beta_i - target_ti). The paper prints + 2 for
// the linear term, but - 2 follows from the paper's own definition of B.
struct CachedObjective {
  using RowMatrix = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::MatrixXf a;  // square matrix over the padded key points
  RowMatrix b;        // fitted poses x padded key points
  double constant = 0;
};

CachedObjective cache_linear_layer(const FitState& state, const TrainingSet& set);

// Returns the error over the fitted poses, without clamping and weighted by set.vertex_weight. If `gradient`
// is not null, resizes it and overwrites it with the gradient with respect to the non-linear parameters. The
// cost is poses x key points^2. A sum over vertices would cost poses x vertices x entries, and would gather
// from scattered addresses.
double evaluate_cached(const FitState& state, const TrainingSet& set, const CachedObjective& cache,
                       std::vector<double>* gradient);

struct LbfgsSettings {
  int iterations = 20;
  int history = 10;
};

// Runs one step over the non-linear parameters, which lowers the cached objective. Returns the final error.
// It is never higher than the error at the start.
double descend_non_linear(FitState& state, const TrainingSet& set, const LbfgsSettings& settings);

}  // namespace nook::bake
