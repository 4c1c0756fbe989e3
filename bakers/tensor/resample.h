// Represents new sub-tensors of the clustered mode with the clusters of an existing fit (section 6.3.2 of the
// paper).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "bakers/tensor/clustered_fit.h"
#include "bakers/tensor/mixture_search.h"

namespace nook::bake::tensor {

// In a map of sub-tensors, reduces the steps between neighbouring cells that mix different clusters.

using WideMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// A map of side x side cells, row by row. Each cell mixes `count` clusters.
struct MixedCells {
  std::size_t side = 0, count = 0;
  std::vector<std::uint32_t> clusters;  // cells x count
  WideMatrix weights;                   // cells x (count R_m), in the order of `clusters`
};

// Called before each round. Return false to stop; lower_steps then throws Failure(NOOK_ERROR_CANCELLED).
using RoundProgress = std::function<bool(std::size_t round, std::size_t most_rounds)>;

// Between neighbouring cells that mix the same clusters, decoding interpolates linearly between the cells'
// centres. If two neighbours mix different clusters, decoding extrapolates from both sides to their border.
// For each side, it uses the cell and the cell behind it, if both mix the same clusters. The two values at
// the border differ by a step.
//
// Minimises the sum of the cells' squared errors plus `penalty` times the sum of squared steps, by conjugate
// gradients that start at the given weights. Does not change the clusters. `products` are the inner products
// of the cells with all atoms: cells x (C R_m). The result has the same bits on any number of threads.
void lower_steps(const AtomGram& atoms, const WideMatrix& products, double penalty, MixedCells& cells,
                 const RoundProgress& progress = {});

// Returns the inner products of A's mode-m sub-tensors with the atoms Z_c x_{n != m} U_{n,c}: I_m x (C R_m).
// There is one atom for each mode-m slice of each core. The atoms of a cluster are orthonormal. The search
// for clusters and the optimal projection need only these products of A.
Matrix atom_projections(const ClusteredFit& fit, const TensorView& a);

// Finds clusters and coefficients of J new sub-tensors. Each new sub-tensor is a weighted sum of A's
// sub-tensors; `weights` is J x I_m. To resample the mode, pass weights that interpolate between directions.
// The function does not compute the new sub-tensors, because their inner products are the same weighted sums.
// For each one, it searches for the best clusters, and the optimal projection gives the coefficients. Use the
// coefficients with the cores and bases of `fit`.
Mixture resample(const ClusteredFit& fit, const Matrix& projections, const Matrix& weights,
                 Pursuit pursuit = Pursuit::greedy);

// Does the same for the cells of a map, side x side. `weights` has one row per cell, and the cells follow row
// by row. Also reduces the steps between cells that mix different clusters, see lower_steps(). Calls
// `progress` before each round of lower_steps().
Mixture resample_map(const ClusteredFit& fit, const Matrix& projections, const Matrix& weights,
                     std::size_t side, double step_penalty, Pursuit pursuit,
                     const RoundProgress& progress = {});

}  // namespace nook::bake::tensor
